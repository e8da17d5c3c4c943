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
    /** Adds the parts into which a triangle is cut so that none is longer than the spacing. */
    void add_parts(const std::array<Point<3>, 3> &corner, const Tensor<1, 3> &area, const SurfaceSpacing<3> &spacing,
                   Surface<3> &surface)
    {
      double n = 1;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int d = 0; d < 3; ++d)
          n = std::max(n, std::ceil(std::abs(corner[k][d] - corner[(k + 1) % 3][d]) / spacing[d] - 1e-9));
      const Tensor<1, 3> u = (corner[1] - corner[0]) / n, v = (corner[2] - corner[0]) / n;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; i + j < n; ++j)
        {
          surface.push_back({corner[0] + (i + 1. / 3) * u + (j + 1. / 3) * v, area / (n * n)});
          if (i + j + 1 < n)
            surface.push_back({corner[0] + (i + 2. / 3) * u + (j + 2. / 3) * v, area / (n * n)});
        }
    }

    void add_parts(const std::array<Point<2>, 2> &corner, const Tensor<1, 2> &area, const SurfaceSpacing<2> &spacing,
                   Surface<2> &surface)
    {
      double n = 1;
      for (unsigned int d = 0; d < 2; ++d)
        n = std::max(n, std::ceil(std::abs(corner[1][d] - corner[0][d]) / spacing[d] - 1e-9));
      for (unsigned int i = 0; i < n; ++i)
        surface.push_back({corner[0] + (i + 0.5) / n * (corner[1] - corner[0]), area / n});
    }

    /** What a closed surface from a file holds; an STL file in 3D, polygons in 2D. */
    template <int dim>
    class SurfaceShape : public FilledRegion<dim>
    {
    public:
      explicit SurfaceShape(const std::string &section) : FilledRegion<dim>(section)
      {
        this->add_parameter("File", file_name,
                            dim == 3 ? "STL file of the body's surface, text or binary, closed." :
                                       "Text file of polygons: 'x y' in each line, the first corner repeated as last.",
                            this->prm, Patterns::FileName());
        this->add_parameter("Scale", scale, "Length of the file's unit [length]: 0.001 for mm in m.", this->prm,
                            Patterns::Double());
        this->add_parameter("Shift", shift, "Where the file's origin lies [length].", this->prm,
                            Patterns::List(Patterns::Double(), dim, dim));
      }

      void parse_parameters(ParameterHandler &) override
      {
        if (!(scale > 0))
          throw EntryError(this->get_section_name(), "Scale", "it must be positive.");
      }

      void read() override
      {
        Tensor<1, dim> move;
        for (unsigned int d = 0; d < dim; ++d)
          move[d] = shift[d];
        try
        {
          surface.emplace(read_surface<dim>(file_name, scale, move));
        }
        catch (const InputError &error)
        {
          throw EntryError(this->get_section_name(), "File", error.message);
        }
      }

      dealii::BoundingBox<dim> bounding_box() const override { return surface->bounding_box(); }
      bool                     contains(const Point<dim> &x) const override { return surface->contains(x); }
      bool                     holds(const Point<dim> &lower, const Point<dim> &upper) const override
      {
        return surface->contains(lower) && !surface->may_meet(lower, upper);
      }
      std::string position_entry() const override { return "Shift"; }

      std::vector<std::string> face_names() const override { return {"surface"}; }
      Surface<dim>             face(const std::string &, const SurfaceSpacing<dim> &spacing) const override
      {
        Surface<dim> result;
        for (const auto &face : surface->faces)
        {
          std::array<Point<dim>, dim> corner;
          for (unsigned int k = 0; k < dim; ++k)
            corner[k] = surface->vertices[face[k]];
          add_parts(corner, surface->area(face), spacing, result);
        }
        return result;
      }

    private:
      std::string                       file_name;
      double                            scale = 1;
      std::vector<double>               shift = std::vector<double>(dim, 0.);
      std::optional<ClosedSurface<dim>> surface;
    };

    const RegisterRegion<SurfaceShape> registration("surface", "closed surface from an STL file; polygons");
  } // namespace
} // namespace Talus
