#include <talus/core/exceptions.h>
#include <talus/particles/particles.h>

#include <algorithm>
#include <unordered_map>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Particles<dim>::take_over(const bool as_they_were)
  {
    const auto n_now = Utilities::MPI::sum<std::uint64_t>(this->size(), grid->communicator);
    AssertThrow(n_now == n_global, InputError("the checkpoint has " + std::to_string(n_now) +
                                              " particles, and the bodies of its run have " + std::to_string(n_global) +
                                              ". Has a file that a body is read from changed?"));
    ++arrangement;
    start_relocation();
    brings_new_nodes = false;
    for (unsigned int p = 0; p < this->size(); ++p)
      this->body[p] = body_of(this->id[p]);

    const unsigned int n_materials = this->material_begin.size() - 1;
    for (unsigned int m = 0; m <= n_materials; ++m)
      this->material_begin[m] = !as_they_were ?
                                  (m == 0 ? 0 : this->size()) :
                                  std::partition_point(this->body.begin(), this->body.end(),
                                                       [&](const unsigned short b) { return body_material[b] < m; }) -
                                    this->body.begin();
    if (!as_they_were)
      find_places();
  }

  template <int dim>
  void Particles<dim>::find_places()
  {
    if (this->keeps_places)
      for (unsigned int p = 0; p < this->size(); ++p)
        this->place[p] = grid->cell_number(Point<dim>(this->vector(this->position, p)));
    synchronise();
  }

  template <int dim>
  std::vector<double> Particles<dim>::counts() const
  {
    std::unordered_map<std::size_t, unsigned int> n_in_cell;
    for (unsigned int p = 0; p < this->size(); ++p)
      ++n_in_cell[this->keeps_places ? this->place[p] : grid->cell_number(Point<dim>(this->vector(this->position, p)))];
    std::vector<double> counts;
    for (const auto &cell : grid->triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const Point<dim> centre = cell->center();
        const auto       found  = n_in_cell.find(grid->cell_number(centre));
        if (found == n_in_cell.end())
          continue;
        counts.insert(counts.end(), centre.begin_raw(), centre.end_raw());
        counts.push_back(found->second);
      }
    return counts;
  }

#define INSTANTIATE(dim)                                                                                               \
  template void                Particles<dim>::take_over(const bool);                                                  \
  template void                Particles<dim>::find_places();                                                          \
  template std::vector<double> Particles<dim>::counts() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus
