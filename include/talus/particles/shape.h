#pragma once

#include <talus/core/function.h>
#include <talus/core/parameters.h>
#include <talus/particles/surface.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

namespace Talus
{
  /**
   * The region that a body fills, and the points with which it is filled: a
   * regular lattice between its bounding box's corners, of which those inside the
   * region become particles, or a list.
   */
  template <int dim>
  class Shape : public dealii::ParameterAcceptor
  {
  public:
    using Point = dealii::Point<dim>;
    /** Receives the index of a point within its body, its position and its volume. */
    using Visitor = std::function<void(const std::uint64_t index, const Point &x, const double volume)>;

    explicit Shape(const std::string &section) : dealii::ParameterAcceptor(section)
    {
      this->add_parameter("Where", where_text,
                          "A formula of x, y, z: the body is the part of the shape where it is not 0, 'y < 3 + "
                          "0.2*sin(x) && x > 1' [length]; empty: all of it.");
    }

    void parse_parameters(dealii::ParameterHandler &) override
    {
      where.initialize(where_text, this->get_section_name(), "Where");
    }

    /** Prepares the points; `h` is the grid's spacing. Throws EntryError for an impossible shape. */
    virtual void create(const std::array<double, dim> &h) = 0;

    virtual dealii::BoundingBox<dim> bounding_box() const = 0;

    /** Visits all points in `box`; points close to it may be visited too. */
    virtual void visit(const dealii::BoundingBox<dim> &box, const Visitor &visitor) const = 0;

    /** Visits the points of part number `part` of `n_parts`, which have each point once. */
    virtual void visit_part(const unsigned int part, const unsigned int n_parts, const Visitor &visitor) const = 0;

    /**
     * The edges of the parallelogram or parallelepiped that a point stands for, from its middle to the middle of a
     * face each: a right-handed basis of volume `volume` / 2^dim, for kernels that follow a particle's domain. Unless
     * a shape knows better, those of a square or a cube.
     */
    virtual std::array<dealii::Tensor<1, dim>, dim> half_edges(const Point & /*x*/, const double volume) const
    {
      std::array<dealii::Tensor<1, dim>, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        edges[d][d] = 0.5 * std::pow(volume, 1. / dim);
      return edges;
    }

    /** Columns of particles that the points have with them, by their names: "velocity_x", "stress_xy". */
    virtual std::vector<std::string> given_columns() const { return {}; }

    /** What a point has in each of these. */
    virtual const double *given_values(const std::uint64_t /*index*/) const { return nullptr; }

    /** Whether x lies within the region that the points stand for, and not on its surface; a list of points has none.
     */
    virtual bool covers(const Point & /*x*/) const { return false; }

    /** Whether the shape is nothing but points: covers() then knows nothing. */
    virtual bool is_list() const { return false; }

    /** Name of the entry that places the shape: the one to blame when it lies outside the grid. */
    virtual std::string position_entry() const = 0;

    /** Name of the entry that says how many points there are. */
    virtual std::string density_entry() const { return "Particles"; }

    /** Names of the faces that make up the surface; none where it is not known. */
    virtual std::vector<std::string> face_names() const { return {}; }

    /** The face called `name` in parts of about this spacing. */
    virtual Surface<dim> face(const std::string & /*name*/, const SurfaceSpacing<dim> & /*spacing*/) const
    {
      return {};
    }

    /** All indices are below this number. */
    virtual std::uint64_t n_indices() const = 0;

  protected:
    /** What the file says of the part of the shape that the body is. */
    ParsedCondition<dim> where;

    /** Where part number `part` of n things in `n_parts` begins; where the last one ends for part = n_parts. */
    static std::uint64_t part_begin(const std::uint64_t n, const unsigned int part, const unsigned int n_parts)
    {
      return n / n_parts * part + std::min<std::uint64_t>(n % n_parts, part);
    }

  private:
    std::string where_text;
  };
} // namespace Talus
