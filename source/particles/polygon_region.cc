#include <talus/core/exceptions.h>
#include <talus/grid/closed_surface.h>
#include <talus/particles/lattice_shape.h>

#include <cmath>
#include <optional>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A polygon in 2D; in 3D a prism that has it as its section across an axis. */
    template <int dim>
    class Polygon : public FilledRegion<dim>
    {
    public:
      explicit Polygon(const std::string &section) : FilledRegion<dim>(section)
      {
        const std::string plane = dim == 2 ? "x, y" : "the two coordinates across the axis, in the order x, y, z";
        this->add_parameter(
          "Corners", corners,
          "Corners along the boundary, either way round: " + plane + " of each, corners separated by ';' [length].",
          this->prm,
          Patterns::List(Patterns::List(Patterns::Double(), 2, 2, ","), 0, Patterns::List::max_int_value, ";"));
        if constexpr (dim == 3)
        {
          this->add_parameter("Axis", axis_name, "Axis of the prism.", this->prm, Patterns::Selection("x|y|z"));
          this->add_parameter("Ends", ends, "Where the prism begins and ends on its axis [length].", this->prm,
                              Patterns::List(Patterns::Double(), 2, 2));
        }
      }

      void parse_parameters(ParameterHandler &) override
      {
        if (corners.size() < 3)
          throw EntryError(this->get_section_name(), "Corners",
                           "a polygon has three corners or more: 'x, y; x, y; x, y'.");
        if (dim == 3 && !(ends[1] > ends[0]))
          throw EntryError(this->get_section_name(), "Ends", "the body is empty: the second must exceed the first.");
        axis = dim == 2 ? 2 : axis_name[0] - 'x';
      }

      dealii::BoundingBox<dim> bounding_box() const override
      {
        const auto section = outline->bounding_box().get_boundary_points();
        return dealii::BoundingBox<dim>({in_space(section.first, ends[0]), in_space(section.second, ends[1])});
      }

      bool        contains(const Point<dim> &x) const override { return outline->contains(across(x)); }
      bool        is_curved(const unsigned int d) const override { return d != axis; }
      std::string position_entry() const override { return "Corners"; }

      bool holds(const Point<dim> &lower, const Point<dim> &upper) const override
      {
        return outline->contains(across(lower)) && !outline->may_meet(across(lower), across(upper));
      }

      std::vector<std::string> face_names() const override
      {
        std::vector<std::string> names;
        for (unsigned int k = 0; k < corners.size(); ++k)
          names.push_back("edge " + std::to_string(k + 1));
        return names;
      }

      Surface<dim> face(const std::string &name, const SurfaceSpacing<dim> &spacing) const override
      {
        const unsigned int   k = std::stoi(name.substr(5)) - 1;
        const Point<2>       a = corner(k), b = corner((k + 1) % corners.size());
        const Tensor<1, 2>   edge = b - a, out = (is_clockwise() ? -1. : 1.) * cross_product_2d(edge);
        const double         depth = dim == 2 ? 1. : ends[1] - ends[0];
        const Tensor<1, dim> area  = in_space(Point<2>(depth * out), 0.);
        double               n = 1, n_along = 1;
        const Tensor<1, dim> span = in_space(Point<2>(edge), 0.);
        for (unsigned int d = 0; d < dim; ++d)
          n = std::max(n, std::ceil(std::abs(span[d]) / spacing[d] - 1e-9));
        if constexpr (dim == 3)
          n_along = std::max(n_along, std::ceil(depth / spacing[axis] - 1e-9));
        Surface<dim> surface;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n_along; ++j)
            surface.push_back(
              {in_space(a + (i + 0.5) / n * edge, ends[0] + (j + 0.5) / n_along * depth), area / (n * n_along)});
        return surface;
      }

    private:
      void read() override
      {
        std::vector<Point<2>> edges;
        for (unsigned int k = 0; k < corners.size(); ++k)
        {
          edges.push_back(corner(k));
          edges.push_back(corner((k + 1) % corners.size()));
        }
        try
        {
          outline.emplace(edges, "Corners");
        }
        catch (const InputError &error)
        {
          throw EntryError(this->get_section_name(), "Corners", error.message);
        }
      }

      Point<2> corner(const unsigned int k) const { return {corners[k][0], corners[k][1]}; }

      bool is_clockwise() const
      {
        double twice_area = 0;
        for (unsigned int k = 0; k < corners.size(); ++k)
        {
          const Point<2> a = corner(k), b = corner((k + 1) % corners.size());
          twice_area +=
            (a[0] - corners[0][0]) * (b[1] - corners[0][1]) - (b[0] - corners[0][0]) * (a[1] - corners[0][1]);
        }
        return twice_area < 0;
      }

      Point<2> across(const Point<dim> &x) const
      {
        Point<2> result;
        for (unsigned int d = 0, k = 0; d < dim; ++d)
          if (d != axis)
            result[k++] = x[d];
        return result;
      }

      Point<dim> in_space(const Point<2> &x, const double along) const
      {
        Point<dim> result;
        for (unsigned int d = 0, k = 0; d < dim; ++d)
          result[d] = d == axis ? along : x[k++];
        return result;
      }

      std::vector<std::vector<double>> corners;
      std::string                      axis_name = "y";
      std::vector<double>              ends      = {0., 1.};
      unsigned int                     axis      = dim;
      std::optional<ClosedSurface<2>>  outline;
    };

    const RegisterRegion<Polygon> registration("polygon", "polygon; a prism in 3D");
  } // namespace
} // namespace Talus
