#include <talus/core/exceptions.h>
#include <talus/core/text_file.h>
#include <talus/particles/raster.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace Talus
{
  namespace
  {
    constexpr double largest_count = 1e6; // along an axis

    std::string lower_case(std::string word)
    {
      std::transform(word.begin(), word.end(), word.begin(), [](const unsigned char c) { return std::tolower(c); });
      return word;
    }

    std::string place(const std::string &file_name, const std::size_t line)
    {
      return file_name + ":" + std::to_string(line + 1) + ": ";
    }
  } // namespace

  Raster::Raster(const std::string &file_name, const double scale) : file_name(file_name)
  {
    const TextFile file(file_name);
    AssertThrow(file.problem.empty(), InputError(file.problem));
    std::size_t line = 0;
    read_head(file.lines, line);
    const std::size_t n = std::size_t(counts[0]) * counts[1];
    std::string       word;
    for (; line < file.lines.size(); ++line)
    {
      std::istringstream words(file.lines[line]);
      while (words >> word)
      {
        double height = 0;
        AssertThrow(read_number(word, height),
                    InputError(place(file_name, line) + "'" + shortened(word) + "' is no number. Correct the line."));
        AssertThrow(heights.size() < n, InputError(place(file_name, line) + "there are more heights than the " +
                                                   std::to_string(counts[0]) + " x " + std::to_string(counts[1]) +
                                                   " of the first lines. Correct 'ncols' and 'nrows'."));
        heights.push_back(height == no_data || !std::isfinite(height) ? std::numeric_limits<double>::quiet_NaN() :
                                                                        scale * height);
      }
    }
    AssertThrow(heights.size() == n,
                InputError("'" + file_name + "' ends after " + std::to_string(heights.size()) + " of " +
                           std::to_string(n) + " heights ('ncols' times 'nrows'). Export the raster again."));
    for (unsigned int j = 0; j < counts[1] / 2; ++j)
      std::swap_ranges(&at(0, j), &at(0, j) + counts[0], &at(0, counts[1] - 1 - j));
    spacing *= scale;
    for (double &x : origin)
      x *= scale;
  }

  void Raster::read_head(const std::vector<std::string> &lines, std::size_t &line)
  {
    std::map<std::string, double> head;
    for (; line < lines.size(); ++line)
    {
      std::istringstream words(lines[line]);
      std::string        name, value;
      double             number = 0;
      if (!(words >> name))
        continue;
      if (read_number(name, number)) // the first height
        break;
      name = lower_case(name);
      AssertThrow(words >> value && read_number(value, number) && std::isfinite(number),
                  InputError(place(file_name, line) + "'" + shortened(name) +
                             "' is followed by no number: an ESRI ASCII grid begins with lines of a name and a number. "
                             "Export the raster in this format."));
      head[name] = number;
    }
    const auto get = [&](const std::string &name, const bool is_there = true) {
      AssertThrow(!is_there || head.count(name) > 0,
                  InputError("'" + file_name + "' has no '" + name +
                             "' in its first lines. Export it as an ESRI ASCII grid, with square cells."));
      return head.count(name) > 0 ? head[name] : std::numeric_limits<double>::quiet_NaN();
    };
    spacing = get("cellsize");
    AssertThrow(spacing > 0, InputError("'" + file_name + "': 'cellsize' must be positive."));
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double count = get(d == 0 ? "ncols" : "nrows");
      AssertThrow(
        count >= 2 && count <= largest_count && count == std::floor(count),
        InputError("'" + file_name + "': '" + (d == 0 ? "ncols" : "nrows") + "' must be a whole number of 2 or more."));
      counts[d]                = static_cast<unsigned int>(count);
      const std::string start  = d == 0 ? "xll" : "yll";
      const double      middle = get(start + "center", false);
      origin[d]                = std::isnan(middle) ? get(start + "corner") + 0.5 * spacing : middle;
    }
    if (head.count("nodata_value") > 0)
      no_data = head["nodata_value"];
  }

  double Raster::height(const double x, const double y) const
  {
    const std::array<double, 2> place = {{x, y}};
    std::array<unsigned int, 2> first;
    std::array<double, 2>       t;
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double along = std::clamp((place[d] - origin[d]) / spacing, 0., counts[d] - 1.);
      first[d]           = std::min(static_cast<unsigned int>(along), counts[d] - 2);
      t[d]               = along - first[d];
    }
    const auto row = [&](const unsigned int j) { return (1 - t[0]) * at(first[0], j) + t[0] * at(first[0] + 1, j); };
    return (1 - t[1]) * row(first[1]) + t[1] * row(first[1] + 1);
  }

  std::array<std::array<unsigned int, 2>, 2> Raster::around(const std::array<double, 2> &from,
                                                            const std::array<double, 2> &to) const
  {
    std::array<std::array<unsigned int, 2>, 2> range;
    for (unsigned int d = 0; d < 2; ++d)
    {
      const auto number = [&](const double along) {
        return static_cast<unsigned int>(std::clamp(along, 0., counts[d] - 1.));
      };
      range[d] = {{number(std::floor((from[d] - origin[d]) / spacing + 1e-9)),
                   number(std::ceil((to[d] - origin[d]) / spacing - 1e-9))}};
    }
    return range;
  }

  std::array<double, 2> Raster::range(const std::array<double, 2> &from, const std::array<double, 2> &to) const
  {
    std::array<double, 2> result = {{height(from[0], from[1]), height(from[0], from[1])}};
    const auto            add    = [&](const double h) {
      result[0] = std::min(result[0], h);
      result[1] = std::max(result[1], h);
    };
    const auto numbers = around(from, to);
    for (unsigned int j = numbers[1][0]; j <= numbers[1][1]; ++j)
      for (unsigned int i = numbers[0][0]; i <= numbers[0][1]; ++i)
        add(height(std::clamp(origin[0] + i * spacing, from[0], to[0]),
                   std::clamp(origin[1] + j * spacing, from[1], to[1])));
    return result;
  }

  void Raster::check_covers(const std::array<double, 2> &from, const std::array<double, 2> &to) const
  {
    const auto rectangle = [](const std::array<double, 2> &a, const std::array<double, 2> &b) {
      std::ostringstream text;
      text << "x from " << a[0] << " to " << b[0] << " and y from " << a[1] << " to " << b[1];
      return text.str();
    };
    const double margin = 1e-9 * spacing;
    for (unsigned int d = 0; d < 2; ++d)
      AssertThrow(from[d] >= lower()[d] - margin && to[d] <= upper()[d] + margin,
                  InputError("the heights of '" + file_name + "' stand at " + rectangle(lower(), upper()) +
                             ", and do not cover " + rectangle(from, to) +
                             ". Take a smaller body, or a larger raster."));
    const auto numbers = around(from, to);
    for (unsigned int j = numbers[1][0]; j <= numbers[1][1]; ++j)
      for (unsigned int i = numbers[0][0]; i <= numbers[0][1]; ++i)
        if (std::isnan(at(i, j)))
        {
          std::ostringstream text;
          text << "'" << file_name << "' has no height at x = " << origin[0] + i * spacing
               << ", y = " << origin[1] + j * spacing << ". Fill the gap, or take a smaller body.";
          throw InputError(text.str());
        }
  }
} // namespace Talus
