#include <talus/core/exceptions.h>
#include <talus/grid/lattice.h>

#include <cstdint>
#include <limits>

namespace Talus
{
  template <int dim>
  void Lattice<dim>::resize_tables(const Index &lower, const Index &upper)
  {
    std::int64_t size = 1;
    for (unsigned int d = 0; d < dim; ++d)
    {
      first[d]  = lower[d] - padding;
      extent[d] = upper[d] - lower[d] + 1 + 2 * padding;
      stride[d] = static_cast<int>(size);
      // Both factors are below 2^31: their product is exact.
      size *= extent[d];
      AssertThrow(size <= std::numeric_limits<int>::max(),
                  InputError("A rank's part of the grid spans more than 2^31 places. Take more ranks, a larger spacing "
                             "or a smaller box."));
    }
    node.assign(size, missing);
    owner.assign(size, missing);
    slip_faces.assign(size, 0);
  }

  template <int dim>
  unsigned int Lattice<dim>::node_at(const Index &index) const
  {
    return is_in_table(index) ? node[table_index(index)] : missing;
  }

  template <int dim>
  std::vector<char> Lattice<dim>::coverage(const int n) const
  {
    std::vector<char> is_covered(node.size(), true);
    for (int entry = 0; entry < static_cast<int>(node.size()); ++entry)
      for_each_index(table_entry(entry), n, [&](const Index &index) {
        bool is_in_domain = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_in_domain = is_in_domain && index[d] >= 0 && index[d] <= n_cells[d];
        if (is_in_domain && node_at(index) == missing)
          is_covered[entry] = false;
      });
    return is_covered;
  }

  template <int dim>
  void Lattice<dim>::find_images()
  {
    beyond.assign(node.size(), 0);
    image.assign(node.size(), missing);
    for (int entry = 0; entry < static_cast<int>(node.size()); ++entry)
    {
      Index index = table_entry(entry);
      for (unsigned int d = 0; d < dim; ++d)
        if (index[d] < 0)
        {
          beyond[entry] |= 1u << 2 * d;
          index[d] = -index[d];
        }
        else if (index[d] > n_cells[d])
        {
          beyond[entry] |= 1u << (2 * d + 1);
          index[d] = 2 * n_cells[d] - index[d];
        }
      if (beyond[entry] != 0 && node_at(index) != missing)
        image[entry] = table_index(index);
    }
  }

  template <int dim>
  void Lattice<dim>::find_slip_faces(const std::vector<Faces> &of_nodes, const int n)
  {
    slip_faces.assign(node.size(), 0);
    for (int entry = 0; entry < static_cast<int>(node.size()); ++entry)
    {
      const Index base      = table_entry(entry);
      bool        is_inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_inside = is_inside && base[d] > 0 && base[d] + n - 1 < n_cells[d];
      if (is_inside)
        continue;
      Faces reached = 0, held = 0;
      for_each_index(base, n, [&](const Index &index) {
        const unsigned int i = node_at(index);
        if (i == missing)
          return;
        Faces faces = 0;
        for (unsigned int d = 0; d < dim; ++d)
          faces |= (index[d] == 0) << 2 * d | (index[d] == n_cells[d]) << (2 * d + 1);
        reached |= faces;
        held |= faces & ~of_nodes[i];
      });
      slip_faces[entry] = reached & ~held;
    }
  }

  template struct Lattice<2>;
  template struct Lattice<3>;
} // namespace Talus
