#include <talus/kernels/mesh/c1_partition.h>

namespace Talus
{
  template <int dim>
  std::vector<FootCoordinates<dim>> foot_coordinates(const Mesh<dim> &mesh)
  {
    std::vector<FootCoordinates<dim>> feet(mesh.n_cells());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      const auto                          gradient = mesh.gradients(c);
      typename FootCoordinates<dim>::Gram gram{};
      for (unsigned int j = 0; j <= dim; ++j)
        for (unsigned int k = 0; k <= dim; ++k)
          for (unsigned int d = 0; d < dim; ++d)
            gram[j][k] += gradient[j][d] * gradient[k][d];
      feet[c].reinit(gram);
    }
    return feet;
  }

  template std::vector<FootCoordinates<1>> foot_coordinates(const Mesh<1> &);
  template std::vector<FootCoordinates<2>> foot_coordinates(const Mesh<2> &);
  template std::vector<FootCoordinates<3>> foot_coordinates(const Mesh<3> &);
} // namespace Talus
