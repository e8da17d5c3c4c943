#include <talus/grid/mesh_input.h>

#include <talus/core/exceptions.h>

namespace Talus
{
  template <int dim>
  unsigned int MeshInput<dim>::find_group(const std::string &name_or_number) const
  {
    std::string known;
    for (unsigned int g = 0; g < groups.size(); ++g)
    {
      const std::string number = std::to_string(groups[g].number);
      if (name_or_number == number || (!groups[g].name.empty() && name_or_number == groups[g].name))
        return g;
      known += (g == 0 ? "" : ", ") + (groups[g].name.empty() ? number : "'" + groups[g].name + "' (" + number + ")");
    }
    throw InputError("The mesh '" + name + "' has no boundary '" + name_or_number + "'. " +
                     (known.empty() ? "It has no physical group of faces." : "It has " + known + "."));
  }

  template struct MeshInput<1>;
  template struct MeshInput<2>;
  template struct MeshInput<3>;
} // namespace Talus
