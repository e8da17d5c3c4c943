#include <talus/core/text_file.h>
#include <talus/particles/point_table.h>
#include <talus/particles/shape.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <set>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /**
     * Particles from a text file: "x y [z] volume" in each line, or columns in any order that a line of names tells
     * apart, others of particles' columns among them; see PointTable.
     */
    template <int dim>
    class PointFile : public Shape<dim>
    {
    public:
      explicit PointFile(const std::string &section) : Shape<dim>(section)
      {
        this->add_parameter(
          "File", file_name,
          "Text file with 'x y [z] volume' in each line [length, volume]; with a line of names first, "
          "columns in any order, of other quantities of particles too.",
          this->prm, Patterns::FileName());
        this->add_parameter("Ignore columns", ignored, "Names of columns that are not read.", this->prm,
                            Patterns::List(Patterns::Anything()));
        this->add_parameter("Only body", only_body,
                            "Of a table with a column 'body' the rows of this one [1]; negative: all.", this->prm,
                            Patterns::Integer());
      }

      void create(const std::array<double, dim> &) override
      {
        const TextFile file(file_name);
        if (!file.problem.empty())
          throw EntryError(this->get_section_name(), "File", file.problem);
        const bool is_named = find_columns(PointTable::header(file.lines));
        PointTable table(columns);
        table.read(file.lines, file_name, is_named);
        take(table);
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
          visit_point(entry.second, visitor);
      }

      void visit_part(const unsigned int part, const unsigned int n_parts,
                      const typename Shape<dim>::Visitor &visitor) const override
      {
        const std::size_t end = this->part_begin(points.size(), part + 1, n_parts);
        for (std::size_t i = this->part_begin(points.size(), part, n_parts); i < end; ++i)
          visit_point(i, visitor);
      }

      bool          is_list() const override { return true; }
      std::uint64_t n_indices() const override { return points.size(); }
      std::string   position_entry() const override { return "File"; }
      std::string   density_entry() const override { return "File"; }

      std::vector<std::string> given_columns() const override { return given; }
      const double *given_values(const std::uint64_t index) const override { return &values[index * given.size()]; }

    private:
      /** Sets `columns` and `given`; true where the table's first line names them. */
      bool find_columns(const std::vector<std::string> &header)
      {
        columns =
          dim == 2 ? std::vector<std::string>{"x", "y", "volume"} : std::vector<std::string>{"x", "y", "z", "volume"};
        const std::set<std::string> needed(columns.begin(), columns.end());
        const auto                  is_needed = [&](const std::string &name) { return needed.count(name) > 0; };
        // Names that stand for others, as V for volume, are PointTable's matter.
        const bool has_all = std::all_of(needed.begin(), needed.end(), [&](const std::string &name) {
          return std::count(header.begin(), header.end(), name) == 1;
        });
        if (!has_all)
        {
          for (const std::string &entry : {std::string("Ignore columns"), std::string("Only body")})
            if (entry == "Only body" ? only_body >= 0 : !ignored.empty())
              throw EntryError(this->get_section_name(), entry,
                               "the table has no such columns: its first line must name all, x, y" +
                                 std::string(dim == 3 ? ", z" : "") + " and volume among them.");
          return false;
        }
        columns = header;
        for (const std::string &name : header)
          if (!is_needed(name) && !is_left_out(name))
            given.push_back(name);
        for (const std::string &name : ignored)
          if (std::find(header.begin(), header.end(), name) == header.end())
            throw EntryError(this->get_section_name(), "Ignore columns", "the table has no column '" + name + "'.");
        if (only_body >= 0 && std::find(header.begin(), header.end(), "body") == header.end())
          throw EntryError(this->get_section_name(), "Only body", "the table has no column 'body'.");
        return true;
      }

      /** What says where a particle belongs is this file's matter, not the table's. */
      bool is_left_out(const std::string &name) const
      {
        return name == "id" || name == "body" || name == "material" ||
               std::find(ignored.begin(), ignored.end(), name) != ignored.end();
      }

      void take(const PointTable &table)
      {
        const auto column = [&](const std::string &name) -> unsigned int {
          return std::find(columns.begin(), columns.end(), name) - columns.begin();
        };
        std::vector<unsigned int> of_given;
        for (const std::string &name : given)
          of_given.push_back(column(name));
        for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          if (only_body >= 0 && table(row, column("body")) != only_body)
            continue;
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = table(row, column(std::string(1, "xyz"[d])));
          points.push_back(x);
          volumes.push_back(table(row, column("volume")));
          AssertThrow(volumes.back() > 0, InputError(file_name + ":" + std::to_string(table.line_of(row)) +
                                                     ": the volume must be positive. Correct the number."));
          for (const unsigned int c : of_given)
            values.push_back(table(row, c));
        }
      }

      void visit_point(const std::size_t i, const typename Shape<dim>::Visitor &visitor) const
      {
        if (this->where.holds(points[i]))
          visitor(i, points[i], volumes[i]);
      }

      std::string                                file_name;
      std::vector<std::string>                   ignored;
      int                                        only_body = -1;
      std::vector<std::string>                   columns; // of the table
      std::vector<std::string>                   given;   // those that are columns of particles
      std::vector<Point<dim>>                    points;
      std::vector<double>                        volumes;
      std::vector<double>                        values; // of the given columns, point by point
      RTree<std::pair<Point<dim>, unsigned int>> tree;
    };

    const RegisterDimensions<Shape, PointFile> registration("points", "list of points and volumes in a text file");
  } // namespace
} // namespace Talus
