#include <talus/core/exceptions.h>
#include <talus/core/text_file.h>
#include <talus/grid/closed_surface.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    std::string read_file(const std::string &name)
    {
      const std::string problem = why_not_read(name, "'" + name + "'");
      AssertThrow(problem.empty(), InputError(problem));
      std::ifstream in(name, std::ios::binary);
      return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    }

    /** `dim` numbers from the words that follow; throws an InputError that begins with `where`. */
    template <int dim>
    Point<dim> read_point(std::istringstream &words, const std::string &where)
    {
      Point<dim>  x;
      std::string word;
      for (unsigned int d = 0; d < dim; ++d)
      {
        AssertThrow(words >> word, InputError(where + ": expected " + std::to_string(dim) + " coordinates, found " +
                                              std::to_string(d) + ". Complete the line."));
        char *end = nullptr;
        x[d]      = std::strtod(word.c_str(), &end);
        AssertThrow(*end == '\0' && std::isfinite(x[d]),
                    InputError(where + ": '" + word + "' is not a finite number. Correct the line."));
      }
      AssertThrow(!(words >> word), InputError(where + ": '" + word + "' comes after " + std::to_string(dim) +
                                               " coordinates. Remove what is too much."));
      return x;
    }

    constexpr std::size_t header_size = 84, triangle_size = 50; // bytes of a binary file

    std::size_t n_triangles(const std::string &bytes)
    {
      std::uint32_t n = 0;
      if (bytes.size() >= header_size)
        std::memcpy(&n, bytes.data() + 80, 4);
      return n;
    }

    std::vector<Point<3>> read_binary(const std::string &bytes, const std::string &name)
    {
      std::vector<Point<3>> corners;
      for (std::size_t t = 0; t < n_triangles(bytes); ++t)
      {
        float numbers[12]; // the normal, three corners
        std::memcpy(numbers, bytes.data() + header_size + triangle_size * t, sizeof(numbers));
        for (unsigned int k = 3; k < 12; k += 3)
        {
          corners.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
          AssertThrow(std::isfinite(corners.back().norm()),
                      InputError("'" + name + "': triangle " + std::to_string(t + 1) +
                                 " has a corner that is not finite. Export the surface again."));
        }
      }
      return corners;
    }

    /** A word of a text file other than 'vertex'; `is_complete`: all facets so far have three vertices. */
    void check_word(const std::string &word, const bool is_complete, const std::string &where)
    {
      const bool is_between = word == "endfacet" || word == "facet" || word == "end";
      AssertThrow(!is_between || is_complete,
                  InputError(where + ": the facet that ends here has not three vertices. Export the surface again, as "
                                     "triangles."));
      AssertThrow(is_between || word == "solid" || word == "endsolid" || word == "outer" || word == "endloop",
                  InputError(where + ": '" + word + "' is no word of an STL file. Correct the line."));
    }

    std::vector<Point<3>> read_text(const std::string &bytes, const std::string &name)
    {
      std::istringstream    in(bytes);
      std::vector<Point<3>> corners;
      std::string           line, word;
      std::size_t           number = 0;
      for (bool is_last = false; !is_last;)
      {
        is_last = !std::getline(in, line);
        ++number;
        const std::string  where = name + ":" + std::to_string(number);
        std::istringstream words(is_last ? "end of file" : line);
        if (!(words >> word))
          continue;
        for (char &c : word)
          c = std::tolower(c);
        if (word == "vertex")
          corners.push_back(read_point<3>(words, where));
        else
          check_word(word, corners.size() % 3 == 0, where);
      }
      return corners;
    }
  } // namespace

  template <>
  ClosedSurface<3> read_surface(const std::string &file_name, const double scale, const Tensor<1, 3> &shift)
  {
    const std::string bytes = read_file(file_name);
    // Headers of binary files may begin with "solid": their size tells.
    const bool is_binary =
      bytes.size() >= header_size && bytes.size() == header_size + triangle_size * n_triangles(bytes);
    AssertThrow(is_binary || bytes.compare(bytes.find_first_not_of(" \t\r\n") % (bytes.size() + 1), 5, "solid") == 0,
                InputError("'" + file_name + "' is no STL file: it does not begin with 'solid', and a binary file of " +
                           "its number of triangles would have " +
                           std::to_string(header_size + triangle_size * n_triangles(bytes)) + " bytes instead of " +
                           std::to_string(bytes.size()) + ". Export the surface again, as STL."));
    auto corners = is_binary ? read_binary(bytes, file_name) : read_text(bytes, file_name);
    for (auto &x : corners)
      x = Point<3>(scale * x + shift);
    return ClosedSurface<3>(corners, file_name);
  }

  template <>
  ClosedSurface<2> read_surface(const std::string &file_name, const double scale, const Tensor<1, 2> &shift)
  {
    std::istringstream    in(read_file(file_name));
    std::vector<Point<2>> corners; // two of each edge
    Point<2>              first, last;
    bool                  is_open = false;
    std::size_t           begin   = 0;
    std::string           line;
    for (std::size_t number = 1; std::getline(in, line); ++number)
    {
      std::istringstream words(line.substr(0, line.find('#')));
      if ((words >> std::ws).eof())
        continue;
      const Point<2> x(scale * read_point<2>(words, file_name + ":" + std::to_string(number)) + shift);
      if (!is_open)
      {
        first   = x;
        begin   = number;
        is_open = true;
      }
      else
      {
        corners.push_back(last);
        corners.push_back(x);
        is_open = x != first;
      }
      last = x;
    }
    AssertThrow(!is_open,
                InputError("the surface in '" + file_name + "' is not closed: the polygon that begins in line " +
                           std::to_string(begin) + " at " + to_text<2>(first) + " ends at " + to_text<2>(last) +
                           ". Repeat its first corner as its last."));
    return ClosedSurface<2>(corners, file_name);
  }
} // namespace Talus
