#include <talus/core/coordinates.h>
#include <talus/core/exceptions.h>
#include <talus/core/function.h>
#include <talus/core/registry.h>
#include <talus/grid/facets.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class Box : public Facets<dim>
    {
    public:
      explicit Box(const std::string &section) : Facets<dim>(section)
      {
        this->add_parameter("Lower corner", lower, "Corner of the box with the smallest coordinates [length].",
                            this->prm, coordinates(dim));
        this->add_parameter("Upper corner", upper, "Corner of the box with the largest coordinates [length].",
                            this->prm, coordinates(dim));
      }

      void parse_parameters(ParameterHandler &) override
      {
        for (unsigned int d = 0; d < dim; ++d)
          if (!(upper[d] > lower[d]))
            throw EntryError(this->get_section_name(), "Upper corner",
                             "the box is empty: this corner must lie above the lower corner in every direction.");
      }

    private:
      ClosedSurface<dim> make() const override
      {
        std::vector<Point<dim>> corners;
        for (unsigned int axis = 0; axis < dim; ++axis)
          for (const bool is_upper : {false, true})
          {
            // Corners of this face: bit d says on which side of the box along axis d.
            const auto at = [&](const unsigned int u, const unsigned int v) {
              Point<dim> x;
              x[axis]                  = is_upper ? upper[axis] : lower[axis];
              const unsigned int first = (axis + 1) % dim, second = (axis + 2) % dim;
              x[first] = u ? upper[first] : lower[first];
              if (dim == 3)
                x[second] = v ? upper[second] : lower[second];
              return x;
            };
            if constexpr (dim == 2)
            {
              // Counterclockwise: along the first other axis where it is the lower y or the upper x face.
              const bool is_forward = (axis == 0) == is_upper;
              corners.push_back(at(is_forward ? 0 : 1, 0));
              corners.push_back(at(is_forward ? 1 : 0, 0));
            }
            else
              for (const auto &triangle :
                   {std::array<int, 6>{{0, 0, 1, 0, 1, 1}}, std::array<int, 6>{{0, 0, 1, 1, 0, 1}}})
                for (unsigned int k = 0; k < 3; ++k)
                {
                  const unsigned int c = is_upper ? k : 2 - k;
                  corners.push_back(at(triangle[2 * c], triangle[2 * c + 1]));
                }
          }
        return ClosedSurface<dim>(corners, "box");
      }

      std::vector<double> lower = std::vector<double>(dim, 0.), upper = std::vector<double>(dim, 1.);
    };

    /** A sphere, or a circle, without facets. */
    template <int dim>
    class Ball : public ContactSurface<dim>
    {
    public:
      explicit Ball(const std::string &section) : ContactSurface<dim>(section)
      {
        this->add_parameter("Centre", centre, "Centre of the ball [length].", this->prm, coordinates(dim));
        this->add_parameter("Radius", radius, "Radius of the ball [length].", this->prm, Patterns::Double());
      }

      void parse_parameters(ParameterHandler &) override
      {
        if (!(radius > 0))
          throw EntryError(this->get_section_name(), "Radius", "it must be positive.");
        middle = to_point<dim>(centre);
      }

      void create(const double reach) override
      {
        this->reach = reach;
        if (!(radius > reach))
          throw EntryError(
            this->get_section_name(), "Radius",
            "the ball is not larger than the distance in which walls are looked for. Take a finer grid.");
      }

      void find(const std::array<const double *, dim> &x, const unsigned int begin, const unsigned int end,
                std::vector<Near<dim>> &near) const override
      {
        for (unsigned int p = begin; p < end; ++p)
        {
          Tensor<1, dim> r;
          for (unsigned int d = 0; d < dim; ++d)
            r[d] = x[d][p] - middle[d];
          const double gap = r.norm() - radius;
          if (std::abs(gap) < reach)
            near.push_back({p, std::abs(gap), (gap > 0 ? 1 : -1) / r.norm() * r});
        }
      }

      bool contains(const Point<dim> &x) const override { return x.distance(middle) < radius; }

      std::optional<SignedDistance<dim>> signed_distance(const Point<dim> &x) const override
      {
        const double r = x.distance(middle);
        if (!(std::abs(r - radius) < reach))
          return {};
        return SignedDistance<dim>{r - radius, (x - middle) / r};
      }

    private:
      std::vector<double> centre = std::vector<double>(dim, 0.);
      double              radius = 1, reach = 0;
      Point<dim>          middle;
    };

    /** What a formula is negative in. */
    template <int dim>
    class Formula : public ContactSurface<dim>
    {
    public:
      explicit Formula(const std::string &section) : ContactSurface<dim>(section)
      {
        this->add_parameter(
          "Formula", text,
          "Negative inside, positive outside [length]: a function of x, y, z that grows away from the "
          "surface, best its distance, 'y - 0.5 * x' or 'sqrt(x^2 + y^2) - 1'.");
      }

      void parse_parameters(ParameterHandler &) override
      {
        if (uses_variable(text, "t"))
          throw EntryError(
            this->get_section_name(), "Formula",
            "it is the shape of a rigid body: leave out t. Obstacles move by 'Displacement' and 'Rotation'.");
        formula.initialize(text, this->get_section_name(), "Formula");
      }

      void create(const double reach) override { this->reach = reach; }

      bool contains(const Point<dim> &x) const override { return formula.value(x, 0.) < 0; }

      std::optional<SignedDistance<dim>> signed_distance(const Point<dim> &x) const override
      {
        // A formula that is no distance becomes one near the surface, over its gradient.
        Tensor<1, dim> gradient;
        const double   step = 1e-4 * reach;
        for (unsigned int d = 0; d < dim; ++d)
        {
          Point<dim> before = x, after = x;
          before[d] -= step;
          after[d] += step;
          gradient[d] = (formula.value(after, 0.) - formula.value(before, 0.)) / (2 * step);
        }
        const double slope = gradient.norm(), value = formula.value(x, 0.);
        if (!(std::abs(value) < reach * slope))
          return {};
        return SignedDistance<dim>{value / slope, gradient / slope};
      }

    private:
      std::string       text = dim == 2 ? "y" : "z";
      ParsedScalar<dim> formula;
      double            reach = 0;
    };

    const RegisterDimensions<ContactSurface, Box>     box("box", "box between two corners");
    const RegisterDimensions<ContactSurface, Ball>    ball("ball", "sphere; a circle in 2D");
    const RegisterDimensions<ContactSurface, Formula> formula("formula",
                                                              "where a formula is zero; inside it is negative");
  } // namespace
} // namespace Talus
