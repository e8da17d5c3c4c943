#include <talus/core/parameter_names.h>
#include <talus/core/parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    unsigned int edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (unsigned int i = 0; i < a.size(); ++i)
      {
        unsigned int diagonal = row[0]++;
        for (unsigned int j = 0; j < b.size(); ++j)
        {
          const bool         is_same = std::tolower(a[i]) == std::tolower(b[j]);
          const unsigned int best    = std::min({row[j] + 1, row[j + 1] + 1, diagonal + !is_same});
          diagonal                   = row[j + 1];
          row[j + 1]                 = best;
        }
      }
      return row.back();
    }
  } // namespace

  std::string parameter_key(const std::string &section, const std::string &entry)
  {
    std::string key = section;
    while (!key.empty() && key.front() == '/')
      key.erase(0, 1);
    return key.empty() ? entry : key + "/" + entry;
  }

  std::string closest(const std::string &word, const std::vector<std::string> &candidates)
  {
    std::string  best;
    unsigned int distance = std::max<unsigned int>(3, word.size() / 3 + 1);
    for (const auto &candidate : candidates)
      if (const unsigned int d = edit_distance(word, candidate); d < distance)
      {
        distance = d;
        best     = candidate;
      }
    return best;
  }

  namespace ParameterNames
  {
    std::string join(const std::vector<std::string> &path)
    {
      std::string key;
      for (const auto &part : path)
        key += (key.empty() ? "" : "/") + part;
      return key;
    }

    std::vector<std::string> split(const std::string &key)
    {
      std::vector<std::string> parts;
      for (const auto &part : Utilities::split_string_list(key, '/'))
        if (!part.empty())
          parts.push_back(part);
      return parts;
    }

    std::string parent(const std::string &key)
    {
      const auto slash = key.rfind('/');
      return slash == std::string::npos ? "" : key.substr(0, slash);
    }

    std::string leaf(const std::string &key)
    {
      const auto slash = key.rfind('/');
      return slash == std::string::npos ? key : key.substr(slash + 1);
    }

    std::string describe(const std::string &key)
    {
      return "entry '" + leaf(key) + "'" + (parent(key).empty() ? "" : " in section '" + parent(key) + "'");
    }

    std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates)
    {
      const std::string best = closest(word, candidates);
      return best.empty() ? "" : " Did you mean '" + best + "'?";
    }
  } // namespace ParameterNames
} // namespace Talus
