#include <talus/grid/mesh_file.h>

#include <talus/core/exceptions.h>
#include <talus/core/text_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <type_traits>

namespace Talus
{
  namespace
  {
    /** Reads the sections of a gmsh file. */
    template <int dim>
    class MshReader
    {
    public:
      explicit MshReader(const std::string &path)
      {
        input.name                = path;
        const std::string problem = why_not_read(path, "the mesh '" + path + "'");
        AssertThrow(problem.empty(), InputError(problem));
        file.open(path);
        n_bytes = std::filesystem::file_size(path);
      }

      MeshInput<dim> read()
      {
        std::string word;
        if (file >> word; word.rfind("\xef\xbb\xbf", 0) == 0) // byte order mark
          word.erase(0, 3);
        if (word != "$MeshFormat")
          refuse_format();
        read_format();
        while (file >> word)
          if (word == "$PhysicalNames")
            read_names();
          else if (word == "$Entities")
            read_entities();
          else if (word == "$PartitionedEntities")
            fail("it is partitioned; write it in one piece, Talus splits it itself");
          else if (word == "$Nodes")
            read_nodes();
          else if (word == "$Elements")
            read_elements();
          else if (word.rfind("$End", 0) != 0 && word.front() == '$')
            skip(word);
        finish();
        return std::move(input);
      }

    private:
      using Entity = std::pair<int, int>; // dimension and tag

      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("The mesh '" + input.name + "' cannot be read: " + what + ".");
      }

      /** Says what a file is that does not begin as one of gmsh. */
      [[noreturn]] void refuse_format() const
      {
        const TextFile text(input.name);
        AssertThrow(text.problem.empty(), InputError("The mesh cannot be read: " + text.problem));
        fail(text.lines.empty() ? "it is empty" : "it is no gmsh file, which begins with $MeshFormat");
      }

      template <class Number = long>
      Number next()
      {
        std::string word;
        if (!(file >> word))
          fail("it ends too early");
        double number = 0;
        if (!read_number(word, number) || !std::isfinite(number) ||
            (std::is_integral_v<Number> && number != std::floor(number)))
          fail((word.front() == '$' ? "a section ends too early: in line " : "in line ") + std::to_string(line()) +
               " '" + shortened(word) + "' stands where a finite number should");
        return static_cast<Number>(number);
      }

      /** The line that has been read last. */
      std::size_t line()
      {
        file.clear();
        std::string all(std::max<std::streamoff>(file.tellg(), 0), ' ');
        file.seekg(0);
        file.read(all.data(), all.size());
        return 1 + std::count(all.begin(), all.end(), '\n');
      }

      /** The number of things that follow, each of a letter and a blank at least. */
      std::size_t next_count()
      {
        const long n = next();
        if (n < 0 || static_cast<std::size_t>(n) > n_bytes / 2)
          fail("it says that " + std::to_string(n) + " nodes follow, which cannot be. Write it again");
        return n;
      }

      void skip(const std::string &section)
      {
        const std::string end = "$End" + section.substr(1);
        for (std::string word; word != end;)
          if (!(file >> word))
            fail("the section " + section + " has no end");
      }

      void         read_format();
      void         read_names();
      void         read_entities();
      void         read_nodes();
      void         read_elements();
      void         read_element(const Entity &entity, const int type);
      unsigned int group_of(const int number);
      void         finish();

      std::ifstream                      file;
      std::size_t                        n_bytes = 0; // of the file
      MeshInput<dim>                     input;
      std::map<int, std::string>         names;       // of physical groups of faces
      std::map<Entity, std::vector<int>> groups;      // physical groups of an entity
      std::map<long, unsigned int>       node_at;     // place of a node by its tag
      std::vector<double>                third;       // of nodes, the coordinate beyond `dim`
      long                               n_lower = 0; // cells of lower dimension
    };

    template <int dim>
    void MshReader<dim>::read_format()
    {
      std::string version;
      file >> version;
      if (version != "4.1")
        fail("it is of version " + version + ", not 4.1. Write it with gmsh -format msh41");
      if (next() != 0)
        fail("it is binary. Write it without gmsh's option -bin");
      next(); // bytes of a number
    }

    template <int dim>
    void MshReader<dim>::read_names()
    {
      for (long n = next(); n > 0; --n)
      {
        const int   dimension = next(), number = next();
        std::string name;
        std::getline(file, name);
        const auto first = name.find('"'), last = name.rfind('"');
        if (first == std::string::npos || first == last)
          fail("a physical name stands without quotation marks");
        if (dimension == dim - 1)
          names[number] = name.substr(first + 1, last - first - 1);
      }
    }

    template <int dim>
    void MshReader<dim>::read_entities()
    {
      long n[4];
      for (long &count : n)
        count = next();
      for (int dimension = 0; dimension < 4; ++dimension)
        for (long i = 0; i < n[dimension]; ++i)
        {
          const Entity entity{dimension, next()};
          for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k)
            next<double>(); // a point, or a box around the entity
          for (long k = next(); k > 0; --k)
            groups[entity].push_back(std::abs(next())); // negative: turned around
          if (dimension > 0)
            for (long k = next(); k > 0; --k)
              next(); // what bounds it
        }
    }

    template <int dim>
    void MshReader<dim>::read_nodes()
    {
      const long n_blocks = next();
      for (int k = 0; k < 3; ++k)
        next();
      for (long block = 0; block < n_blocks; ++block)
      {
        const int dimension = next();
        next();
        const bool        is_parametric = next() != 0;
        std::vector<long> tags(next_count());
        for (long &tag : tags)
          tag = next();
        for (const long tag : tags)
        {
          double x[3];
          for (double &c : x)
            c = next<double>();
          for (int k = 0; is_parametric && k < dimension; ++k)
            next<double>();
          node_at[tag] = input.positions.size();
          input.node_numbers.push_back(tag);
          input.positions.emplace_back();
          std::copy(x, x + dim, input.positions.back().begin());
          third.push_back(dim < 3 ? x[2] : 0.);
        }
      }
    }

    template <int dim>
    void MshReader<dim>::read_elements()
    {
      const long n_blocks = next();
      for (int k = 0; k < 3; ++k)
        next();
      for (long block = 0; block < n_blocks; ++block)
      {
        const int    dimension = next();
        const Entity entity{dimension, next()};
        const int    type = next();
        for (long n = next(); n > 0; --n)
          read_element(entity, type);
      }
    }

    template <int dim>
    void MshReader<dim>::read_element(const Entity &entity, const int type)
    {
      static const std::map<int, int> n_nodes   = {{15, 1}, {1, 2}, {2, 3}, {4, 4}};
      const long                      tag       = next();
      const auto                      simplex   = n_nodes.find(type);
      const int                       dimension = entity.first;
      if (simplex == n_nodes.end())
        fail("element " + std::to_string(tag) + " has gmsh's type " + std::to_string(type) + ", which is no straight " +
             "triangle or tetrahedron (types 2 and 4). Mesh without recombination, with elements of first order");
      if (dimension > dim)
        fail("element " + std::to_string(tag) + " is a tetrahedron, but the run has " + std::to_string(dim) +
             " dimensions");
      if (simplex->second != dimension + 1)
        fail("element " + std::to_string(tag) + " of type " + std::to_string(type) + " is of another dimension");
      unsigned int vertices[4];
      for (int k = 0; k < simplex->second; ++k)
      {
        const long node  = next();
        const auto place = node_at.find(node);
        if (place == node_at.end())
          fail("element " + std::to_string(tag) + " has node " + std::to_string(node) + ", which does not exist");
        vertices[k] = place->second;
      }
      if (dimension == dim)
      {
        input.cells.emplace_back();
        std::copy(vertices, vertices + dim + 1, input.cells.back().begin());
        input.cell_numbers.push_back(tag);
      }
      else if (dimension == dim - 1)
      {
        ++n_lower;
        for (const int number : groups[entity])
        {
          input.faces.push_back({{}, group_of(number)});
          std::copy(vertices, vertices + dim, input.faces.back().vertices.begin());
        }
      }
    }

    template <int dim>
    unsigned int MshReader<dim>::group_of(const int number)
    {
      for (unsigned int g = 0; g < input.groups.size(); ++g)
        if (input.groups[g].number == static_cast<unsigned int>(number))
          return g;
      const auto name = names.find(number);
      input.groups.push_back({static_cast<unsigned int>(number), name == names.end() ? "" : name->second});
      return input.groups.size() - 1;
    }

    template <int dim>
    void MshReader<dim>::finish()
    {
      if (input.cells.empty())
        fail(std::string("it has no ") + (dim == 2 ? "triangles" : "tetrahedra") +
             (n_lower > 0 ? ", only cells of dimension " + std::to_string(dim - 1) : "") + ", but the run has " +
             std::to_string(dim) + " dimensions. Mesh it with gmsh -" + std::to_string(dim));
      for (unsigned int v = 0; v < third.size(); ++v)
        if (third[v] != third[0])
          fail("node " + std::to_string(input.node_numbers[v]) + " has z = " + std::to_string(third[v]) + ", others " +
               std::to_string(third[0]) + ": a mesh in two dimensions must be plane");
    }
  } // namespace

  template <int dim>
  MeshInput<dim> read_msh(const std::string &path)
  {
    return MshReader<dim>(path).read();
  }

  template MeshInput<2> read_msh(const std::string &);
  template MeshInput<3> read_msh(const std::string &);
} // namespace Talus
