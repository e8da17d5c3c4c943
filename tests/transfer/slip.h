#pragma once

#include "transfer.h"

/** Slip walls: what the tests of the projection of the affine field and of the mirror share. */
namespace Test
{
  inline const std::string project = set("Slip projection", "true");

  /** Conditions of one type each on some faces. */
  inline std::string walls(const std::vector<std::pair<std::string, std::string>> &list)
  {
    std::string names, content;
    for (const auto &[type, faces] : list)
    {
      const std::string name = "w" + std::to_string(content.size());
      names += (names.empty() ? "" : ", ") + name;
      content += section(name, set("Type", type) + faces);
    }
    return section("Conditions", set("Names", names) + content);
  }

  inline std::string faces(const std::string &ids) { return set("Boundary ids", ids); }

  template <int dim>
  std::string slip_in_y()
  {
    return walls({{"slip", faces("2, 3")}});
  }

  template <int dim>
  std::string small_box(const std::string &treatment, const std::string &transfer, const std::string &more)
  {
    return full_box<dim>("quadratic B-spline", treatment, transfer, more);
  }
} // namespace Test
