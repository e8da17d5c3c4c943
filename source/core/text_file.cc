#include <talus/core/text_file.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <sys/stat.h>
#include <utility>

namespace Talus
{
  namespace
  {
    /** Replaces `old` by `now` wherever it stands. */
    void replace_all(std::string &text, const std::string &old, const std::string &now)
    {
      for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += now.size())
        text.replace(at, old.size(), now);
    }

    bool begins_with(const std::string &text, const std::string &start) { return text.rfind(start, 0) == 0; }

    /** What a file that is no text seems to be, or nothing. */
    std::string kind_of(const std::string &bytes)
    {
      if (begins_with(bytes, "\xff\xfe") || begins_with(bytes, "\xfe\xff"))
        return "UTF-16 text";
      if (begins_with(bytes, "\x1f\x8b") || begins_with(bytes, "BZh") ||
          begins_with(bytes, "\xfd"
                             "7zXZ"))
        return "a packed file";
      if (begins_with(bytes, "PK\x03\x04"))
        return "a zip archive, as spreadsheets are";
      // Every other byte of Latin text in UTF-16 is zero.
      const std::string head     = bytes.substr(0, 64);
      std::size_t       zeros[2] = {0, 0};
      for (std::size_t i = 0; i < head.size(); ++i)
        zeros[i % 2] += head[i] == '\0';
      if (head.size() > 3 &&
          ((zeros[0] == 0 && zeros[1] + 1 >= head.size() / 2) || (zeros[1] == 0 && zeros[0] + 1 >= head.size() / 2)))
        return "UTF-16 text";
      for (const unsigned char byte : bytes)
        if (byte < 9 || (byte > 13 && byte < 26) || (byte > 27 && byte < 32))
          return "a binary file";
      return "";
    }

    /** Whether bytes beyond ASCII stand for letters of one byte each, and not of UTF-8. */
    bool is_latin(const std::string &bytes)
    {
      for (std::size_t i = 0; i < bytes.size(); ++i)
      {
        const unsigned char first = bytes[i];
        if (first < 0x80)
          continue;
        const std::size_t n = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
        if (n == 0 || i + n >= bytes.size())
          return true;
        for (std::size_t k = 1; k <= n; ++k)
          if ((static_cast<unsigned char>(bytes[i + k]) & 0xc0) != 0x80)
            return true;
        i += n;
      }
      return false;
    }
  } // namespace

  void read_text(const std::string &bytes, const std::string &name, std::vector<std::string> &lines,
                 std::string &problem)
  {
    const std::string kind = kind_of(bytes);
    if (!kind.empty())
    {
      problem = name + " is " + kind + ". Save it as plain text (UTF-8 or ASCII).";
      return;
    }
    std::string text = bytes;
    replace_all(text, "\xef\xbb\xbf", ""); // byte order mark, also where files were joined
    replace_all(text, "\r\n", "\n");
    replace_all(text, "\r", "\n");
    replace_all(text, "\x1a", ""); // what DOS ends files with
    if (is_latin(text))
      replace_all(text, "\xa0", " ");
    else
    {
      // What has no width: zero-width space, its joiners and marks of direction, word joiner, soft hyphen.
      for (const char *nothing :
           {"\xe2\x80\x8b", "\xe2\x80\x8c", "\xe2\x80\x8d", "\xe2\x80\x8e", "\xe2\x80\x8f", "\xe2\x81\xa0", "\xc2\xad"})
        replace_all(text, nothing, "");
      // No-break, narrow no-break, mathematical and ideographic space, and those from en quad to hair space; minus
      // sign.
      for (const char *blank : {"\xc2\xa0", "\xe2\x80\xaf", "\xe2\x81\x9f", "\xe3\x80\x80"})
        replace_all(text, blank, " ");
      for (char last = '\x80'; last <= '\x8a'; ++last)
        replace_all(text, std::string("\xe2\x80") + last, " ");
      replace_all(text, "\xe2\x88\x92", "-");
    }
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
  }

  std::string why_not_read(const std::string &path, const std::string &name)
  {
    struct stat status;
    if (stat(path.c_str(), &status) != 0)
      return "cannot read " + name + ": " + std::strerror(errno) +
             ". Check the name and the directory talus is started in.";
    if (S_ISDIR(status.st_mode))
      return "cannot read " + name + ": it is a directory. Check the name: give that of a file.";
    if (!std::ifstream(path))
      return "cannot read " + name + ": there is no permission. Check who may read it.";
    return "";
  }

  bool read_number(const std::string &word, double &number)
  {
    char *end = nullptr;
    number    = std::strtod(word.c_str(), &end);
    if (!word.empty() && *end == '\0')
      return true;
    static const std::regex fortran("([+-]?(?:\\d+\\.?\\d*|\\.\\d+))(?:[dD]([+-]?\\d+)|([+-]\\d{3}))");
    std::smatch             parts;
    if (!std::regex_match(word, parts, fortran))
      return false;
    number = std::strtod((parts[1].str() + "e" + parts[2].str() + parts[3].str()).c_str(), &end);
    return true;
  }

  TextFile::TextFile(const std::string &path, const std::string &purpose)
  {
    const std::string name = (purpose.empty() ? "" : purpose + " ") + "'" + path + "'";
    problem                = why_not_read(path, name);
    std::ifstream in(path, std::ios::binary);
    if (!problem.empty() || in.peek() == std::ifstream::traits_type::eof())
      return;
    std::ostringstream bytes;
    bytes << in.rdbuf();
    read_text(bytes.str(), name, lines, problem);
  }
} // namespace Talus
