#include <talus/core/coordinates.h>
#include <talus/particles/lattice_shape.h>

#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Whether a convex region has a box. */
    template <int dim>
    bool has_corners(const FilledRegion<dim> &region, const Point<dim> &lower, const Point<dim> &upper)
    {
      return holds_on_lattice<dim>(lower, upper, 2, [&](const Point<dim> &x) { return region.contains(x); });
    }

    /** The box between two corners; "Lower corner", "Upper corner". */
    template <int dim>
    class Box : public FilledRegion<dim>
    {
    public:
      explicit Box(const std::string &section) : FilledRegion<dim>(section)
      {
        this->add_parameter("Lower corner", lower, "Corner of the body with the smallest coordinates [length].",
                            this->prm, coordinates(dim));
        this->add_parameter("Upper corner", upper, "Corner of the body with the largest coordinates [length].",
                            this->prm, coordinates(dim));
      }

      BoundingBox<dim> bounding_box() const override
      {
        for (unsigned int d = 0; d < dim; ++d)
          if (!(upper[d] > lower[d]))
            throw EntryError(this->get_section_name(), "Upper corner",
                             "the body is empty: this corner must lie above the lower corner in every direction.");
        return BoundingBox<dim>({to_point<dim>(lower), to_point<dim>(upper)});
      }
      bool        contains(const Point<dim> &) const override { return true; }
      bool        is_curved(const unsigned int) const override { return false; }
      std::string position_entry() const override { return "Lower corner"; }

      std::vector<std::string> face_names() const override
      {
        std::vector<std::string> names = {"x-", "x+", "y-", "y+"};
        if (dim == 3)
          names.insert(names.end(), {"z-", "z+"});
        return names;
      }
      Surface<dim> face(const std::string &name, const SurfaceSpacing<dim> &spacing) const override
      {
        const unsigned int number = 2 * (name[0] - 'x') + (name[1] == '+');
        return box_face(to_point<dim>(lower), to_point<dim>(upper), number, spacing);
      }

    private:
      std::vector<double> lower = std::vector<double>(dim, 0.), upper = std::vector<double>(dim, 1.);
    };

    /** All points closer to a centre than the radius: a disk in 2D. */
    template <int dim>
    class Ball : public FilledRegion<dim>
    {
    public:
      explicit Ball(const std::string &section) : FilledRegion<dim>(section)
      {
        this->add_parameter("Centre", centre, "Centre of the ball [length].", this->prm, coordinates(dim));
        this->add_parameter("Radius", radius, "Radius of the ball [length].", this->prm, Patterns::Double());
      }

      BoundingBox<dim> bounding_box() const override
      {
        if (!(radius > 0))
          throw EntryError(this->get_section_name(), "Radius", "the body is empty: the radius must be positive.");
        Tensor<1, dim> diagonal;
        for (unsigned int d = 0; d < dim; ++d)
          diagonal[d] = radius;
        return BoundingBox<dim>({to_point<dim>(centre) - diagonal, to_point<dim>(centre) + diagonal});
      }
      bool        contains(const Point<dim> &x) const override { return x.distance(to_point<dim>(centre)) < radius; }
      bool        holds(const Point<dim> &a, const Point<dim> &b) const override { return has_corners(*this, a, b); }
      std::string position_entry() const override { return "Centre"; }

      std::vector<std::string> face_names() const override { return {"side"}; }
      Surface<dim>             face(const std::string &, const SurfaceSpacing<dim> &spacing) const override
      {
        return sphere(to_point<dim>(centre), radius, spacing);
      }

    private:
      std::vector<double> centre = std::vector<double>(dim, 0.);
      double              radius = 1;
    };

    /** A cylinder between two planes of constant coordinate along its axis. */
    template <int dim>
    class Cylinder : public FilledRegion<dim>
    {
    public:
      explicit Cylinder(const std::string &section) : FilledRegion<dim>(section)
      {
        this->add_parameter("Centre", centre, "Middle of the cylinder's base [length].", this->prm, coordinates(dim));
        this->add_parameter("Radius", radius, "Radius of the cylinder [length].", this->prm, Patterns::Double());
        this->add_parameter("Height", height, "Extent along the axis, upwards from the base [length].", this->prm,
                            Patterns::Double());
        this->add_parameter("Axis", axis, "Direction of the axis.", this->prm,
                            Patterns::Selection(dim == 2 ? "x|y" : "x|y|z"));
      }

      BoundingBox<dim> bounding_box() const override
      {
        if (!(radius > 0))
          throw EntryError(this->get_section_name(), "Radius", "the body is empty: the radius must be positive.");
        if (!(height > 0))
          throw EntryError(this->get_section_name(), "Height", "the body is empty: the height must be positive.");
        Point<dim> lower = to_point<dim>(centre), upper = lower;
        for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] -= d == along() ? 0. : radius;
          upper[d] += d == along() ? height : radius;
        }
        return BoundingBox<dim>({lower, upper});
      }
      bool contains(const Point<dim> &x) const override
      {
        Tensor<1, dim> r = x - to_point<dim>(centre);
        r[along()]       = 0;
        return r.norm() < radius;
      }
      bool        is_curved(const unsigned int d) const override { return dim == 3 && d != along(); }
      bool        holds(const Point<dim> &a, const Point<dim> &b) const override { return has_corners(*this, a, b); }
      std::string position_entry() const override { return "Centre"; }

      std::vector<std::string> face_names() const override { return {"side", "base", "top"}; }
      Surface<dim>             face(const std::string &name, const SurfaceSpacing<dim> &spacing) const override
      {
        const Point<dim> base = to_point<dim>(centre);
        return name == "side" ? cylinder_side(base, radius, height, along(), spacing) :
                                cylinder_end(base, radius, height, along(), name == "top", spacing);
      }

    private:
      unsigned int along() const { return axis[0] - 'x'; }

      std::vector<double> centre = std::vector<double>(dim, 0.);
      double              radius = 1, height = 1;
      std::string         axis = "y";
    };

    const RegisterRegion<Box>      box("box", "box between two corners");
    const RegisterRegion<Ball>     ball("ball", "ball; a disk in 2D");
    const RegisterRegion<Cylinder> cylinder("cylinder", "cylinder along a coordinate axis; a rectangle in 2D");
  } // namespace
} // namespace Talus
