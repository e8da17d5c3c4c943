#include <talus/particles/shape.h>

#include <deal.II/base/numbers.h>
#include <deal.II/particles/particle.h>

#include <algorithm>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    constexpr double radians = numbers::PI / 180;

    /**
     * A ring or a sector of one around the z axis, filled by a polar lattice: points at
     * the middle of equal parts in radius R, angle and, in 3D, height. A point stands for
     * @f$ V = R\,\Delta R\,\Delta\Theta\,(\Delta z) @f$, and its half edges @f$ \Delta R/2 @f$ along the radius,
     * @f$ R\,\Delta\Theta/2 @f$ along the circle @f$ (, \Delta z/2) @f$ span exactly that volume. The sum of all
     * volumes is that of the ring. Test: tests/particles/half_edges.cc.
     */
    template <int dim>
    class Ring : public Shape<dim>
    {
    public:
      using Point = dealii::Point<dim>;

      explicit Ring(const std::string &section) : Shape<dim>(section)
      {
        this->add_parameter("Centre", centre, "Middle of the ring; in 3D of its base [length].", this->prm,
                            Patterns::List(Patterns::Double(), dim, dim));
        this->add_parameter("Inner radius", inner, "Radius of the inner rim [length].", this->prm, Patterns::Double(0));
        this->add_parameter("Outer radius", outer, "Radius of the outer rim [length].", this->prm, Patterns::Double(0));
        this->add_parameter("Start angle", start, "Where the sector begins, from the x axis to the y axis [degree].",
                            this->prm, Patterns::Double(-360, 360));
        this->add_parameter("End angle", end, "Where it ends [degree]; 360 beyond the start angle is the whole ring.",
                            this->prm, Patterns::Double(-360, 720));
        if (dim == 3)
          this->add_parameter("Height", height, "Extent along z, upwards from the base [length].", this->prm,
                              Patterns::Double(0));
        this->add_parameter("Particles", counts,
                            dim == 2 ? "Number of particles along the radius and around the sector." :
                                       "Number of particles along the radius, around the sector and along z.",
                            this->prm, Patterns::List(Patterns::Integer(1), dim, dim));
      }

      void parse_parameters(ParameterHandler &prm) override
      {
        Shape<dim>::parse_parameters(prm);
        if (!(outer > inner))
          throw EntryError(this->get_section_name(), "Outer radius",
                           "the body is empty: it must be greater than the inner radius.");
        if (!(end > start && end - start <= 360))
          throw EntryError(this->get_section_name(), "End angle",
                           "it must exceed the start angle by at most 360 degrees.");
        if (dim == 3 && !(height > 0))
          throw EntryError(this->get_section_name(), "Height", "the body is empty: the height must be positive.");
        double n = 1;
        for (const unsigned int count : counts)
          n *= count;
        if (n > std::numeric_limits<types::particle_index>::max())
          throw EntryError(this->get_section_name(), "Particles", "these are more than this deal.II can number.");
      }

      void create(const std::array<double, dim> &) override
      {
        spacing[0] = (outer - inner) / counts[0];
        spacing[1] = (end - start) * radians / counts[1];
        if (dim == 3)
          spacing[dim - 1] = height / counts[dim - 1];
      }

      BoundingBox<dim> bounding_box() const override
      {
        Point lower, upper;
        for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = centre[d] - (d < 2 ? outer : 0.);
          upper[d] = centre[d] + (d < 2 ? outer : height);
        }
        return BoundingBox<dim>({lower, upper});
      }

      std::uint64_t n_indices() const override
      {
        std::uint64_t n = 1;
        for (const unsigned int count : counts)
          n *= count;
        return n;
      }

      std::string position_entry() const override { return "Centre"; }

      std::array<Tensor<1, dim>, dim> half_edges(const Point &x, const double) const override
      {
        const double                    X = x[0] - centre[0], Y = x[1] - centre[1], R = std::hypot(X, Y);
        std::array<Tensor<1, dim>, dim> edges;
        edges[0][0] = 0.5 * spacing[0] * X / R;
        edges[0][1] = 0.5 * spacing[0] * Y / R;
        edges[1][0] = -0.5 * spacing[1] * Y;
        edges[1][1] = 0.5 * spacing[1] * X;
        if (dim == 3)
          edges[dim - 1][dim - 1] = 0.5 * spacing[dim - 1];
        return edges;
      }

      void visit(const BoundingBox<dim> &box, const typename Shape<dim>::Visitor &visitor) const override
      {
        const auto corners = box.get_boundary_points();
        const View view    = look_at(corners.first, corners.second);
        Range      heights = {0, 1};
        if (dim == 3)
          heights = range(dim - 1, corners.first[dim - 1] - centre[dim - 1], corners.second[dim - 1] - centre[dim - 1]);
        const Range radii = range(0, view.nearest - inner, view.farthest - inner);
        // A box that reaches across the sector's start sees its end, which is a turn earlier, as well.
        constexpr double turn = 2 * numbers::PI;
        const double from = view.lowest - start * radians - turn * std::floor((view.lowest - start * radians) / turn);
        std::array<Range, 2> angles = {
          {range(1, from - turn, from - turn + view.width), range(1, from, from + view.width)}};
        angles[1].begin = std::max(angles[1].begin, angles[0].end);
        for (unsigned int k = heights.begin; k < heights.end; ++k)
          for (const Range &angle : angles)
            for (unsigned int j = angle.begin; j < angle.end; ++j)
              for (unsigned int i = radii.begin; i < radii.end; ++i)
                visit_point(i, j, k, visitor);
      }

      void visit_part(const unsigned int part, const unsigned int n_parts,
                      const typename Shape<dim>::Visitor &visitor) const override
      {
        const std::uint64_t end = this->part_begin(n_indices(), part + 1, n_parts);
        for (std::uint64_t index = this->part_begin(n_indices(), part, n_parts); index < end; ++index)
          visit_point(index % counts[0], index / counts[0] % counts[1], index / counts[0] / counts[1], visitor);
      }

      bool covers(const Point &x) const override
      {
        constexpr double margin = 1e-6; // of a particle's distance
        const double     X = x[0] - centre[0], Y = x[1] - centre[1], R = std::hypot(X, Y);
        constexpr double turn  = 2 * numbers::PI;
        double           angle = std::atan2(Y, X) - start * radians;
        angle -= turn * std::floor(angle / turn);
        const double at[3] = {R - inner, angle, dim == 3 ? x[dim - 1] - centre[dim - 1] : 0.};
        for (unsigned int d = 0; d < dim; ++d)
          if (!(at[d] > margin * spacing[d] && at[d] < (counts[d] - margin) * spacing[d]) &&
              !(d == 1 && end - start == 360))
            return false;
        return this->where.holds(x);
      }

    private:
      struct Range
      {
        unsigned int begin, end;
      };

      /** Least and greatest distance of a box from the axis, and the angles under which it is seen from there. */
      struct View
      {
        double nearest, farthest, lowest, width;
      };

      /** The points whose distance from the lattice's beginning lies in [from, to], and some more. */
      Range range(const unsigned int axis, const double from, const double to) const
      {
        const double n = counts[axis], begin = std::clamp(std::floor(from / spacing[axis]) - 1, 0., n),
                     end = std::clamp(std::ceil(to / spacing[axis]) + 1, begin, n);
        return {static_cast<unsigned int>(begin), static_cast<unsigned int>(end)};
      }

      View look_at(const Point &lower, const Point &upper) const
      {
        std::array<double, 2> gap, reach, middle;
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double a = lower[d] - centre[d], b = upper[d] - centre[d];
          gap[d]    = std::max({a, -b, 0.});
          reach[d]  = std::max(-a, b);
          middle[d] = 0.5 * a + 0.5 * b;
        }
        View view = {std::hypot(gap[0], gap[1]), std::hypot(reach[0], reach[1]), 0., 2 * numbers::PI};
        if (view.nearest == 0)
          return view;
        // Seen from outside a box is narrower than half a turn: its corners lie on both sides of its middle.
        const double towards = std::atan2(middle[1], middle[0]);
        double       least = 0, most = 0;
        for (const double x : {lower[0] - centre[0], upper[0] - centre[0]})
          for (const double y : {lower[1] - centre[1], upper[1] - centre[1]})
          {
            const double aside = std::remainder(std::atan2(y, x) - towards, 2 * numbers::PI);
            least              = std::min(least, aside);
            most               = std::max(most, aside);
          }
        view.lowest = towards + least;
        view.width  = most - least;
        return view;
      }

      void visit_point(const unsigned int i, const unsigned int j, const unsigned int k,
                       const typename Shape<dim>::Visitor &visitor) const
      {
        const double R = inner + (i + 0.5) * spacing[0], angle = start * radians + (j + 0.5) * spacing[1];
        Point        x;
        x[0]          = centre[0] + R * std::cos(angle);
        x[1]          = centre[1] + R * std::sin(angle);
        double volume = R * spacing[0] * spacing[1];
        if (dim == 3)
        {
          x[dim - 1] = centre[dim - 1] + (k + 0.5) * spacing[dim - 1];
          volume *= spacing[dim - 1];
        }
        if (this->where.holds(x))
          visitor(i + counts[0] * (j + counts[1] * k), x, volume);
      }

      std::vector<double>       centre = std::vector<double>(dim, 0.);
      double                    inner = 0.5, outer = 1, start = 0, end = 360, height = 1;
      std::vector<unsigned int> counts = std::vector<unsigned int>(dim, 8);
      std::array<double, dim>   spacing;
    };

    const RegisterDimensions<Shape, Ring> registration("ring", "ring or sector around the z axis on a polar lattice");
  } // namespace
} // namespace Talus
