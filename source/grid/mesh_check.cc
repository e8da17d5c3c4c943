#include <talus/grid/mesh_check.h>

#include <talus/core/exceptions.h>
#include <talus/grid/bins.h>
#include <talus/grid/simplex.h>

#include <deal.II/base/point.h>

namespace Talus
{
  namespace
  {
    // A height or a distance below this share of the longest edge is none.
    constexpr double smallest_share = 1e-6;

    /** Finds what is wrong with a mesh, and says it. */
    template <int dim>
    class MeshCheck
    {
    public:
      using Vector  = typename MeshInput<dim>::Vector;
      using Corners = typename MeshInput<dim>::Corners;

      explicit MeshCheck(const MeshInput<dim> &input) : input(input) {}

      void run()
      {
        if (input.cells.empty())
          fail("it has no cells", "");
        check_nodes();
        check_shapes();
        collect_faces();
        check_faces();
        check_hanging_nodes();
      }

    private:
      struct Face
      {
        std::array<unsigned int, dim> vertices; // ascending
        unsigned int                  cell, opposite;
      };

      std::string node(const unsigned int v) const
      {
        dealii::Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = input.positions[v][d];
        return "node " + std::to_string(input.node_number(v)) + " at " + to_text(x);
      }

      std::string cell(const unsigned int c) const
      {
        dealii::Point<dim> middle;
        for (const unsigned int v : input.cells[c])
          for (unsigned int d = 0; d < dim; ++d)
            middle[d] += input.positions[v][d] / (dim + 1);
        return std::string(cell_word<dim>()) + " " + std::to_string(input.cell_number(c)) + " around " +
               to_text(middle);
      }

      [[noreturn]] void fail(const std::string &what, const std::string &remedy) const
      {
        throw InputError("The mesh '" + input.name + "' cannot be used: " + what + "." +
                         (remedy.empty() ? "" : " " + remedy));
      }

      double longest_edge(const unsigned int c) const
      {
        double longest = 0;
        for (const unsigned int u : input.cells[c])
          for (const unsigned int v : input.cells[c])
            longest = std::max(longest, distance(input.positions[u], input.positions[v]));
        return longest;
      }

      double orientation(const unsigned int c) const
      {
        return determinant(edges<dim>(input.positions, input.cells[c]));
      }

      void check_nodes() const;
      void check_shapes() const;
      void collect_faces();
      void check_faces() const;
      void check_hanging_nodes() const;
      // Beyond a face the cell's coordinate of the opposite vertex is negative; on it all others are not.
      void check_node_near(const Face &face, const std::array<Vector, dim> &gradient, const unsigned int v) const;
      bool is_against_most(const unsigned int c) const;

      const MeshInput<dim> &input;
      std::vector<Face>     faces;
    };

    template <int dim>
    void MeshCheck<dim>::check_nodes() const
    {
      std::vector<char> is_used(input.positions.size(), 0);
      for (const auto &cell : input.cells)
        for (const unsigned int v : cell)
          is_used[v] = 1;
      for (unsigned int v = 0; v < is_used.size(); ++v)
        if (!is_used[v])
          fail(
            node(v) + " belongs to no " + cell_word<dim>(),
            "Put what belongs to the mesh into physical groups, so that gmsh writes nothing else (such as the centres "
            "of circles).");
    }

    /** Twice the area over the longest edge is a triangle's least height; alike in 3D, up to a factor near 1. */
    template <int dim>
    void MeshCheck<dim>::check_shapes() const
    {
      for (unsigned int c = 0; c < input.cells.size(); ++c)
        if (!(std::abs(orientation(c)) > smallest_share * std::pow(longest_edge(c), dim)))
          fail(cell(c) + " is flat", "Mesh it anew, for instance with gmsh's option -optimize.");
    }

    template <int dim>
    void MeshCheck<dim>::collect_faces()
    {
      for (unsigned int c = 0; c < input.cells.size(); ++c)
        for (unsigned int k = 0; k <= dim; ++k)
        {
          Face face{{}, c, k};
          for (unsigned int i = 0; i < dim; ++i)
            face.vertices[i] = input.cells[c][(k + 1 + i) % (dim + 1)];
          std::sort(face.vertices.begin(), face.vertices.end());
          faces.push_back(face);
        }
      std::sort(faces.begin(), faces.end(), [](const Face &a, const Face &b) { return a.vertices < b.vertices; });
    }

    /** Whether the vertices of most cells turn the other way: then this one was turned over, not its neighbours. */
    template <int dim>
    bool MeshCheck<dim>::is_against_most(const unsigned int c) const
    {
      unsigned int n_alike = 0;
      for (unsigned int other = 0; other < input.cells.size(); ++other)
        n_alike += (orientation(other) > 0) == (orientation(c) > 0);
      return 2 * n_alike < input.cells.size();
    }

    template <int dim>
    void MeshCheck<dim>::check_faces() const
    {
      // On which side of its face a cell lies, by the ascending order of the vertices that both cells agree on.
      const auto side = [&](const Face &face) {
        Corners corners;
        std::copy(face.vertices.begin(), face.vertices.end(), corners.begin());
        corners[dim] = input.cells[face.cell][face.opposite];
        return determinant(edges<dim>(input.positions, corners)) > 0;
      };
      for (std::size_t i = 1; i < faces.size(); ++i)
        if (faces[i].vertices == faces[i - 1].vertices)
        {
          const unsigned int a = faces[i - 1].cell, b = faces[i].cell;
          if (i + 1 < faces.size() && faces[i + 1].vertices == faces[i].vertices)
            fail("more than two cells meet at a face, among them " + cell(a) + ", " + cell(b) + " and " +
                   cell(faces[i + 1].cell),
                 "Mesh it anew; overlapping volumes must be joined before, in gmsh by BooleanFragments.");
          if (side(faces[i]) == side(faces[i - 1]))
          {
            const bool is_a = is_against_most(a);
            fail(cell(is_a ? a : b) + " is inverted: it overlaps its neighbour, " + cell(is_a ? b : a),
                 "Mesh it anew, or move the vertices back.");
          }
        }
    }

    template <int dim>
    void MeshCheck<dim>::check_hanging_nodes() const
    {
      std::vector<const Face *> outer;
      std::vector<char>         is_outer(input.positions.size(), 0);
      for (std::size_t i = 0; i < faces.size(); ++i)
        if ((i == 0 || faces[i - 1].vertices != faces[i].vertices) &&
            (i + 1 == faces.size() || faces[i + 1].vertices != faces[i].vertices))
        {
          outer.push_back(&faces[i]);
          for (const unsigned int v : faces[i].vertices)
            is_outer[v] = 1;
        }
      std::vector<unsigned int>    nodes;
      std::vector<GrowingBox<dim>> places;
      for (unsigned int v = 0; v < is_outer.size(); ++v)
        if (is_outer[v])
        {
          nodes.push_back(v);
          places.emplace_back();
          places.back().add(input.positions[v]);
        }
      const Bins<dim> bins(places);

      for (const Face *face : outer)
      {
        const auto      gradient = dual(edges<dim>(input.positions, input.cells[face->cell]));
        const auto     &corners  = input.cells[face->cell];
        const double    margin   = smallest_share * longest_edge(face->cell);
        GrowingBox<dim> box;
        for (const unsigned int v : face->vertices)
          box.add(input.positions[v]);
        for (unsigned int d = 0; d < dim; ++d)
        {
          box.lower[d] -= margin;
          box.upper[d] += margin;
        }
        bins.for_near(box.lower, box.upper, [&](const unsigned int i) {
          if (std::find(corners.begin(), corners.end(), nodes[i]) == corners.end())
            check_node_near(*face, gradient, nodes[i]);
        });
      }
    }

    template <int dim>
    void MeshCheck<dim>::check_node_near(const Face &face, const std::array<Vector, dim> &gradient,
                                         const unsigned int v) const
    {
      const auto                 &corners = input.cells[face.cell];
      std::array<double, dim + 1> B;
      B[0] = 1;
      for (unsigned int k = 0; k < dim; ++k)
      {
        B[k + 1] = 0;
        for (unsigned int e = 0; e < dim; ++e)
          B[k + 1] += gradient[k][e] * (input.positions[v][e] - input.positions[corners[0]][e]);
        B[0] -= B[k + 1];
      }
      const auto near_zero = [](const double b) { return std::abs(b) < smallest_share; };
      if (!near_zero(B[face.opposite]) || *std::min_element(B.begin(), B.end()) < -smallest_share)
        return;
      for (unsigned int k = 0; k <= dim; ++k)
        if (near_zero(1 - B[k]))
          fail(node(v) + " and " + node(corners[k]) + " lie at the same place, so that the cells around them (" +
                 cell(face.cell) + ") are not joined",
               "Remove duplicate nodes, in gmsh by 'Coherence Mesh'.");
      fail(node(v) + " hangs on a face of " + cell(face.cell) + ", of which it is no vertex",
           "Split that cell: meshes must be conforming.");
    }
  } // namespace

  template <int dim>
  void check_mesh(const MeshInput<dim> &input)
  {
    MeshCheck<dim>(input).run();
  }

  template void check_mesh(const MeshInput<1> &);
  template void check_mesh(const MeshInput<2> &);
  template void check_mesh(const MeshInput<3> &);
} // namespace Talus
