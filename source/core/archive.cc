#include <talus/core/archive.h>

namespace Talus
{
  void Archive::exchange(Numbers &all, const std::string &name, std::vector<double> &numbers)
  {
    if (reads)
    {
      const auto found = all.find(prefix + name);
      if (lacks && found == all.end())
        return;
      AssertThrow(found != all.end(),
                  InputError("the checkpoint has no '" + prefix + name +
                             "'. It was written by another version of Talus; go on with that one."));
      numbers = found->second;
    }
    else
    {
      const bool is_new = all.emplace(prefix + name, numbers).second;
      AssertThrow(is_new, dealii::ExcMessage("'" + prefix + name + "' stands twice in an archive."));
    }
  }

  double Archive::the_one(const std::string &name, const std::vector<double> &numbers) const
  {
    AssertThrow(numbers.size() == 1,
                InputError("the checkpoint has " + std::to_string(numbers.size()) + " numbers '" + prefix + name +
                           "' instead of one. It was written by another version of Talus; go on with that one."));
    return numbers[0];
  }
} // namespace Talus
