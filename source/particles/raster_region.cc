#include <talus/core/exceptions.h>
#include <talus/particles/lattice_shape.h>
#include <talus/particles/raster.h>

#include <optional>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** The ground below a surface of heights, down to a level or to another surface; z is upwards. */
    template <int dim>
    class RasterRegion : public FilledRegion<dim>
    {
    public:
      explicit RasterRegion(const std::string &section) : FilledRegion<dim>(section)
      {
        this->add_parameter("File", file_name, "ESRI ASCII grid of the heights of the surface.", this->prm,
                            Patterns::FileName());
        this->add_parameter("Bottom", bottom, "Height of the body's base [length].", this->prm, Patterns::Double());
        this->add_parameter("Bottom file", bottom_file,
                            "ESRI ASCII grid of the heights of its base, in place of 'Bottom'; empty: none.", this->prm,
                            Patterns::Anything());
        this->add_parameter("Scale", scale, "Length of the files' unit [length].", this->prm, Patterns::Double());
        this->add_parameter("Lower corner", lower,
                            "x and y where the body begins [length]; empty: where the heights do.", this->prm,
                            Patterns::List(Patterns::Double(), 0, 2));
        this->add_parameter("Upper corner", upper, "x and y where it ends [length]; empty: where the heights do.",
                            this->prm, Patterns::List(Patterns::Double(), 0, 2));
      }

      void parse_parameters(ParameterHandler &) override
      {
        if (dim == 2)
          throw EntryError(this->get_section_name(), "Shape",
                           "a raster is a surface in 3 dimensions. In 2D take a 'polygon'.");
        if (!(scale > 0))
          throw EntryError(this->get_section_name(), "Scale", "it must be positive.");
        for (const auto &[entry, corner] : {std::make_pair("Lower corner", &lower), {"Upper corner", &upper}})
          if (corner->size() == 1)
            throw EntryError(this->get_section_name(), entry, "give x and y, or nothing.");
      }

      BoundingBox<dim> bounding_box() const override
      {
        Point<dim> a, b;
        for (unsigned int d = 0; d < 2; ++d)
        {
          a[d] = from[d];
          b[d] = to[d];
        }
        a[dim - 1] = base ? base->range(from, to)[0] : bottom;
        b[dim - 1] = surface->range(from, to)[1];
        return BoundingBox<dim>({a, b});
      }

      bool contains(const Point<dim> &x) const override
      {
        return x[dim - 1] > base_height(x[0], x[1]) && x[dim - 1] < surface->height(x[0], x[1]);
      }
      bool        is_curved(const unsigned int d) const override { return d == 2; }
      std::string position_entry() const override { return "File"; }

    private:
      void read() override
      {
        surface = raster("File", file_name);
        if (!bottom_file.empty())
          base = raster("Bottom file", bottom_file);
        for (unsigned int d = 0; d < 2; ++d)
        {
          from[d] = lower.empty() ? surface->lower()[d] : lower[d];
          to[d]   = upper.empty() ? surface->upper()[d] : upper[d];
          if (!(to[d] > from[d]))
            throw EntryError(this->get_section_name(), "Upper corner",
                             "the body is empty: it must lie above the lower corner along both axes.");
        }
        check_covers("File", *surface);
        if (base)
          check_covers("Bottom file", *base);
        check_order();
      }

      std::optional<Raster> raster(const std::string &entry, const std::string &name) const
      {
        try
        {
          return Raster(name, scale);
        }
        catch (const InputError &error)
        {
          throw EntryError(this->get_section_name(), entry, error.message);
        }
      }

      void check_covers(const std::string &entry, const Raster &heights) const
      {
        try
        {
          heights.check_covers(from, to);
        }
        catch (const InputError &error)
        {
          throw EntryError(this->get_section_name(), entry, error.message);
        }
      }

      /** The base must not come through the surface. */
      void check_order() const
      {
        constexpr unsigned int n = 200;
        for (unsigned int i = 0; i <= n; ++i)
          for (unsigned int j = 0; j <= n; ++j)
          {
            const double x = from[0] + (to[0] - from[0]) * i / n, y = from[1] + (to[1] - from[1]) * j / n;
            if (base_height(x, y) <= surface->height(x, y))
              continue;
            std::ostringstream text;
            text << "the base lies above the surface at x = " << x << ", y = " << y << " (" << base_height(x, y)
                 << " above " << surface->height(x, y) << "). Lower the base, or take a smaller body.";
            throw EntryError(this->get_section_name(), base ? "Bottom file" : "Bottom", text.str());
          }
      }

      double base_height(const double x, const double y) const { return base ? base->height(x, y) : bottom; }

      std::string           file_name, bottom_file;
      double                bottom = 0, scale = 1;
      std::vector<double>   lower, upper;
      std::array<double, 2> from{}, to{};
      std::optional<Raster> surface, base;
    };

    const RegisterRegion<RasterRegion> registration("raster", "ground below the heights of an ESRI ASCII grid, in 3D");
  } // namespace
} // namespace Talus
