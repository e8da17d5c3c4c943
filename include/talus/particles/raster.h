#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * Heights on a regular horizontal grid, as geographic information systems export them: an ESRI ASCII grid, with
   * `ncols`, `nrows`, `xllcorner` or `xllcenter`, `yllcorner` or `yllcenter`, `cellsize` and `NODATA_value` in its
   * first lines, then rows of heights from north (high y) to south. A height is that of the middle of its cell; between
   * the middles it is bilinear. Test: tests/particles/regions.cc.
   */
  class Raster
  {
  public:
    /** Coordinates and heights are multiplied by `scale` [length per unit of the file]. Throws InputError. */
    Raster(const std::string &file_name, const double scale);

    /** Where its outermost heights stand: x and y of the first, of the last [length]. */
    std::array<double, 2> lower() const { return origin; }
    std::array<double, 2> upper() const
    {
      return {{origin[0] + spacing * (counts[0] - 1), origin[1] + spacing * (counts[1] - 1)}};
    }

    /** The height at a point; beyond the outermost heights that of the nearest point on their lines [length]. */
    double height(const double x, const double y) const;

    /** Greatest and least height in a rectangle, of the grid's own points in it and of its corners. */
    std::array<double, 2> range(const std::array<double, 2> &from, const std::array<double, 2> &to) const;

    /** Throws InputError, with the place, where a height is missing that this rectangle needs. */
    void check_covers(const std::array<double, 2> &from, const std::array<double, 2> &to) const;

  private:
    void read_head(const std::vector<std::string> &lines, std::size_t &line);

    /** The numbers of columns and rows of the grid's points that a rectangle needs, from .. to. */
    std::array<std::array<unsigned int, 2>, 2> around(const std::array<double, 2> &from,
                                                      const std::array<double, 2> &to) const;

    double &at(const unsigned int i, const unsigned int j) { return heights[i + std::size_t(counts[0]) * j]; }
    double  at(const unsigned int i, const unsigned int j) const { return heights[i + std::size_t(counts[0]) * j]; }

    std::string                 file_name;
    std::array<unsigned int, 2> counts{};
    std::array<double, 2>       origin{};
    double                      spacing = 0, no_data = -9999;
    std::vector<double>         heights; // row by row, from south; NaN where there is none
  };
} // namespace Talus
