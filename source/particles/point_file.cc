#include <talus/particles/shape.h>

#include <deal.II/numerics/rtree.h>

#include <fstream>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Particles from a text file: "x y [z] volume" in each line, # begins a comment. */
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
        std::ifstream in(file_name);
        if (!in)
          throw EntryError(this->get_section_name(), "File",
                           "cannot read '" + file_name + "'. Check the name and the directory talus is started in.");
        std::string line;
        for (unsigned int number = 1; std::getline(in, line); ++number)
        {
          line = line.substr(0, line.find('#'));
          if (line.find_first_not_of(" \t\r") != std::string::npos)
            read(line, file_name + ":" + std::to_string(number));
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

      std::uint64_t n_indices() const override { return points.size(); }
      std::string  position_entry() const override { return "File"; }

    private:
      void read(const std::string &line, const std::string &where)
      {
        std::istringstream  in(line);
        std::vector<double> numbers;
        std::string         word;
        while (in >> word)
        {
          std::size_t end = 0;
          try
          {
            numbers.push_back(std::stod(word, &end));
          }
          catch (const std::exception &)
          {
          }
          AssertThrow(end == word.size() && std::isfinite(numbers.back()),
                      InputError(where + ": '" + word + "' is not a finite number. Correct the line."));
        }
        AssertThrow(numbers.size() == dim + 1,
                    InputError(where + ": expected " + std::to_string(dim + 1) + " numbers (" +
                               (dim == 2 ? "x y volume" : "x y z volume") + "), found " +
                               std::to_string(numbers.size()) + ". Complete or remove the line."));
        AssertThrow(numbers.back() > 0, InputError(where + ": the volume must be positive. Correct the last number."));
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = numbers[d];
        points.push_back(x);
        volumes.push_back(numbers.back());
      }

      std::string                                file_name;
      std::vector<Point<dim>>                    points;
      std::vector<double>                        volumes;
      RTree<std::pair<Point<dim>, unsigned int>> tree;
    };

    const RegisterDimensions<Shape, PointFile> registration("points", "list of points and volumes in a text file");
  } // namespace
} // namespace Talus
