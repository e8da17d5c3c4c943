#include <talus/boundary/friction_accounts.h>

#include <map>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void FrictionAccounts<dim>::serialize(Archive &archive, const Grid<dim> &grid,
                                        const std::vector<const std::vector<unsigned int> *> &nodes)
  {
    std::vector<double> numbers; // position, axis, account and mean of each
    for (const auto &[key, account] : next.empty() ? now : next)
    {
      const Point<dim> x = grid.node_position(key / dim);
      numbers.insert(numbers.end(), x.begin_raw(), x.end_raw());
      numbers.insert(numbers.end(), {static_cast<double>(key % dim), account[0], account[1]});
    }
    archive.of_rank("accounts", numbers);
    if (!archive.is_reading())
      return;
    std::map<std::vector<double>, unsigned int> at;
    for (const auto *list : nodes)
      for (const unsigned int i : *list)
      {
        const Point<dim> x               = grid.node_position(i);
        at[{x.begin_raw(), x.end_raw()}] = i;
      }
    forget();
    for (unsigned int k = 0; k + dim + 3 <= numbers.size(); k += dim + 3)
      if (const auto node = at.find({&numbers[k], &numbers[k] + dim}); node != at.end())
        now[key(node->second, static_cast<unsigned int>(numbers[k + dim]))] = {
          {numbers[k + dim + 1], numbers[k + dim + 2]}};
  }

  template class FrictionAccounts<2>;
  template class FrictionAccounts<3>;
} // namespace Talus
