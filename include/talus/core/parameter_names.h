#pragma once

#include <string>
#include <vector>

/** Names of sections and entries, as keys "Section/Subsection/Entry" and in messages. */
namespace Talus::ParameterNames
{
  std::string join(const std::vector<std::string> &path);

  /** The parts of "/A/B" or "A/B"; none for "" and "/". */
  std::vector<std::string> split(const std::string &key);

  std::string parent(const std::string &key);
  std::string leaf(const std::string &key);

  /** "entry 'x' in section 'y'". */
  std::string describe(const std::string &key);

  /** " Did you mean 'x'?", or nothing where no candidate is like the word. */
  std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates);
} // namespace Talus::ParameterNames
