#include <talus/core/coordinates.h>
#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/grid/facets.h>
#include <talus/grid/simplex_grid.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
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

    /** The edges of a polygon. */
    class Outline : public Facets<2>
    {
    public:
      using Facets<2>::Facets;

      std::vector<Point> edges; // both ends of each

    private:
      ClosedSurface<2> make() const override { return ClosedSurface<2>(edges, "Corners"); }
    };

    /** A polygon; in 3D a prism that has it as its section across an axis. */
    template <int dim>
    class Polygon : public ContactSurface<dim>
    {
    public:
      explicit Polygon(const std::string &section) : ContactSurface<dim>(section), outline(section)
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
          throw EntryError(this->get_section_name(), "Ends", "the prism is empty: the second must exceed the first.");
        axis = dim == 2 ? 2 : axis_name[0] - 'x';
      }

      void create(const double reach) override
      {
        this->reach = reach;
        outline.edges.clear();
        for (unsigned int k = 0; k < corners.size(); ++k)
          for (const auto &corner : {corners[k], corners[(k + 1) % corners.size()]})
            outline.edges.emplace_back(corner[0], corner[1]);
        try
        {
          outline.create(reach);
        }
        catch (const InputError &error)
        {
          throw EntryError(this->get_section_name(), "Corners", error.message);
        }
      }

      bool contains(const Point<dim> &x) const override
      {
        return outline.contains(across(x)) && (dim == 2 || (x[axis % dim] > ends[0] && x[axis % dim] < ends[1]));
      }

      std::optional<SignedDistance<dim>> signed_distance(const Point<dim> &x) const override
      {
        const auto of_outline = outline.signed_distance(across(x));
        if (!of_outline && !outline.contains(across(x)))
          return {};
        SignedDistance<dim> found{-reach, {}};
        if (of_outline)
        {
          found.value = of_outline->value;
          for (unsigned int d = 0, k = 0; d < dim; ++d)
            found.normal[d] = d == axis ? 0. : of_outline->normal[k++];
        }
        if constexpr (dim == 3)
          cut(x[axis], found);
        if (!(std::abs(found.value) < reach))
          return {};
        return found;
      }

    private:
      Point<2> across(const Point<dim> &x) const
      {
        Point<2> result;
        for (unsigned int d = 0, k = 0; d < dim; ++d)
          if (d != axis)
            result[k++] = x[d];
        return result;
      }

      /** From the distance of an endless prism to that of one with ends. */
      void cut(const double along, SignedDistance<dim> &found) const
      {
        const bool     is_upper = along > 0.5 * (ends[0] + ends[1]);
        const double   end      = is_upper ? along - ends[1] : ends[0] - along;
        Tensor<1, dim> out;
        out[axis % dim] = is_upper ? 1 : -1;
        if (found.value > 0 && end > 0) // beyond an edge
        {
          const double distance = std::hypot(found.value, end);
          found                 = {distance, (found.value * found.normal + end * out) / distance};
        }
        else if (end > found.value)
          found = {end, out};
      }

      Outline                          outline;
      std::vector<std::vector<double>> corners;
      std::string                      axis_name = "y";
      std::vector<double>              ends      = {0., 1.};
      unsigned int                     axis      = dim;
      double                           reach     = 0;
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

    const RegisterDimensions<ContactSurface, Polygon>      polygon("polygon", "polygon; a prism in 3D");
    const RegisterDimensions<ContactSurface, MeshBoundary> mesh("mesh", "boundary of the grid's mesh");
    const RegisterDimensions<ContactSurface, FromFile>     file("surface", "closed surface from an STL file; polygons");
  } // namespace
} // namespace Talus
