#include <talus/core/component_names.h>

#include <algorithm>

namespace Talus
{
  namespace
  {
    const std::vector<std::string> symmetric_suffixes{"_xx", "_yy", "_zz", "_xy", "_xz", "_yz"};

    bool is_called(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
    }
  } // namespace

  std::vector<std::string> component_names(const std::string &name, const unsigned int dim, const unsigned int n)
  {
    std::string base = name;
    std::replace(base.begin(), base.end(), ' ', '_');
    if (n == 1)
      return {base};
    // In 2D a stress has as many components as a full tensor; its name tells them apart.
    const bool is_symmetric =
      n == (dim == 2 ? 4 : 6) && (n != dim * dim || is_called(name, "stress") || is_called(name, "strain"));
    std::vector<std::string> names;
    for (unsigned int c = 0; c < n; ++c)
      if (n == dim)
        names.push_back(base + "_" + "xyz"[c]);
      else if (is_symmetric)
        names.push_back(base + symmetric_suffixes[c]);
      else if (n == dim * dim)
        names.push_back(base + "_" + "xyz"[c / dim] + "xyz"[c % dim]);
      else
        names.push_back(base + "_" + std::to_string(c));
    return names;
  }
} // namespace Talus
