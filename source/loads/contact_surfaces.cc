#include <talus/core/coordinates.h>
#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/grid/closed_surface.h>
#include <talus/grid/simplex_grid.h>
#include <talus/loads/contact_surface.h>
#include <talus/loads/nearest.h>

#include <optional>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A surface in flat parts; derived classes say which. */
    template <int dim>
    class Facets : public ContactSurface<dim>
    {
    public:
      using ContactSurface<dim>::ContactSurface;

      void create(const double reach) override
      {
        this->reach = reach;
        surface.emplace(make());
        std::vector<GrowingBox<dim>> boxes(surface->faces.size());
        for (unsigned int f = 0; f < boxes.size(); ++f)
          for (const unsigned int v : surface->faces[f])
            for (const double side : {-reach, reach})
            {
              std::array<double, dim> corner;
              for (unsigned int d = 0; d < dim; ++d)
                corner[d] = surface->vertices[v][d] + side;
              boxes[f].add(corner);
            }
        bins.emplace(boxes);
      }

      void find(const std::array<const double *, dim> &x, const unsigned int begin, const unsigned int end,
                std::vector<Near<dim>> &near) const override
      {
        for (unsigned int p = begin; p < end; ++p)
        {
          std::array<double, dim> place;
          Point<dim>              x_p, best;
          for (unsigned int d = 0; d < dim; ++d)
            x_p[d] = place[d] = x[d][p];
          double least = reach * reach;
          bins->for_near(place, place, [&](const unsigned int f) {
            std::array<Point<dim>, dim> corner;
            for (unsigned int k = 0; k < dim; ++k)
              corner[k] = surface->vertices[surface->faces[f][k]];
            const Point<dim> y      = nearest_point(x_p, corner);
            const double     square = (x_p - y).norm_square();
            if (square < least)
            {
              least = square;
              best  = y;
            }
          });
          if (least < reach * reach)
            near.push_back({p, std::sqrt(least), (x_p - best) / std::sqrt(least)});
        }
      }

      bool contains(const Point<dim> &x) const override { return surface->contains(x); }

    private:
      virtual ClosedSurface<dim> make() const = 0;

      double                            reach = 0;
      std::optional<ClosedSurface<dim>> surface;
      std::optional<Bins<dim>>          bins;
    };

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

    template <int dim>
    class FromFile : public Facets<dim>
    {
    public:
      explicit FromFile(const std::string &section) : Facets<dim>(section)
      {
        this->add_parameter("File", file_name,
                            dim == 3 ? "STL file of the surface, text or binary, closed." :
                                       "Text file of polygons: 'x y' in each line, the first corner repeated as last.",
                            this->prm, Patterns::FileName());
        this->add_parameter("Scale", scale, "Length of the file's unit [length]: 0.001 for mm in m.", this->prm,
                            Patterns::Double());
        this->add_parameter("Shift", shift, "Where the file's origin lies [length].", this->prm, coordinates(dim));
      }

      void parse_parameters(ParameterHandler &) override
      {
        if (!(scale > 0))
          throw EntryError(this->get_section_name(), "Scale", "it must be positive.");
      }

    private:
      ClosedSurface<dim> make() const override
      {
        try
        {
          return read_surface<dim>(file_name, scale, to_point<dim>(shift));
        }
        catch (const InputError &error)
        {
          throw EntryError(this->get_section_name(), "File", error.message);
        }
      }

      std::string         file_name;
      double              scale = 1;
      std::vector<double> shift = std::vector<double>(dim, 0.);
    };

    /** The boundary of the grid's mesh, on every rank. */
    template <int dim>
    class MeshBoundary : public Facets<dim>
    {
    public:
      using Facets<dim>::Facets;

      void attach(const Grid<dim> &grid) override
      {
        simplex_grid(grid, this->get_section_name(), "Surface");
        std::vector<Point<dim>> here;
        for (const auto &cell : grid.triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary())
              {
                std::array<Point<dim>, dim> corner;
                for (unsigned int k = 0; k < dim; ++k)
                  corner[k] = face->vertex(k);
                // All turned alike, as seen from the cells.
                if (normal(corner) * (corner[0] - cell->barycenter()) < 0)
                  std::swap(corner[0], corner[1]);
                here.insert(here.end(), corner.begin(), corner.end());
              }
        corners.clear();
        for (const auto &of_rank : Utilities::MPI::all_gather(grid.communicator, here))
          corners.insert(corners.end(), of_rank.begin(), of_rank.end());
      }

    private:
      static Tensor<1, dim> normal(const std::array<Point<dim>, dim> &corner)
      {
        if constexpr (dim == 2)
          return cross_product_2d(corner[1] - corner[0]);
        else
          return cross_product_3d(corner[1] - corner[0], corner[2] - corner[0]);
      }

      ClosedSurface<dim> make() const override { return ClosedSurface<dim>(corners, "the boundary of the mesh"); }

      std::vector<Point<dim>> corners;
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

    private:
      std::vector<double> centre = std::vector<double>(dim, 0.);
      double              radius = 1, reach = 0;
      Point<dim>          middle;
    };

    const RegisterDimensions<ContactSurface, Box>          box("box", "box between two corners");
    const RegisterDimensions<ContactSurface, Ball>         ball("ball", "sphere; a circle in 2D");
    const RegisterDimensions<ContactSurface, MeshBoundary> mesh("mesh", "boundary of the grid's mesh");
    const RegisterDimensions<ContactSurface, FromFile>     file("surface", "closed surface from an STL file; polygons");
  } // namespace
} // namespace Talus
