#include <talus/core/text_file.h>
#include <talus/particles/point_table.h>
#include <talus/particles/shape.h>

#include <deal.II/numerics/rtree.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Particles from a text file: "x y [z] volume" in each line; see PointTable. */
    template <int dim>
    class PointFile : public Shape<dim>
    {
    public:
      explicit PointFile(const std::string &section) : Shape<dim>(section)
      {
        this->add_parameter("File", file_name, "Text file with 'x y [z] volume' in each line [length, volume].",
                            this->prm, Patterns::FileName());
      }

      void create(const std::array<double, dim> &) override
      {
        const TextFile file(file_name);
        if (!file.problem.empty())
          throw EntryError(this->get_section_name(), "File", file.problem);
        const std::vector<std::string> names =
          dim == 2 ? std::vector<std::string>{"x", "y", "volume"} : std::vector<std::string>{"x", "y", "z", "volume"};
        PointTable table(names);
        table.read(file.lines, file_name);
        for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = table(row, d);
          points.push_back(x);
          volumes.push_back(table(row, dim));
          AssertThrow(volumes.back() > 0, InputError(file_name + ":" + std::to_string(table.line_of(row)) +
                                                     ": the volume must be positive. Correct the last number."));
        }
        if (points.empty())
          throw EntryError(this->get_section_name(), "File",
                           "the body is empty: '" + file_name +
                             "' contains no points. Give one in each line: x y [z] volume.");
        std::vector<std::pair<Point<dim>, unsigned int>> entries;
        for (unsigned int i = 0; i < points.size(); ++i)
          entries.emplace_back(points[i], i);
        tree = pack_rtree(entries);
      }

      BoundingBox<dim> bounding_box() const override { return BoundingBox<dim>(points); }

      void visit(const BoundingBox<dim> &box, const typename Shape<dim>::Visitor &visitor) const override
      {
        namespace bgi = boost::geometry::index;
        for (const auto &entry : tree | bgi::adaptors::queried(bgi::intersects(box)))
          visitor(entry.second, entry.first, volumes[entry.second]);
      }

      void visit_part(const unsigned int part, const unsigned int n_parts,
                      const typename Shape<dim>::Visitor &visitor) const override
      {
        const std::size_t end = this->part_begin(points.size(), part + 1, n_parts);
        for (std::size_t i = this->part_begin(points.size(), part, n_parts); i < end; ++i)
          visitor(i, points[i], volumes[i]);
      }

      bool          is_list() const override { return true; }
      std::uint64_t n_indices() const override { return points.size(); }
      std::string   position_entry() const override { return "File"; }
      std::string   density_entry() const override { return "File"; }

    private:
      std::string                                file_name;
      std::vector<Point<dim>>                    points;
      std::vector<double>                        volumes;
      RTree<std::pair<Point<dim>, unsigned int>> tree;
    };

    const RegisterDimensions<Shape, PointFile> registration("points", "list of points and volumes in a text file");
  } // namespace
} // namespace Talus
