#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace Talus
{
  /**
   * The stencil nodes of each cell: its vertices (ring 0) first, then all vertices joined to them by an edge (ring 1),
   * ascending. Bit u of `touches` is A_uv: the node is the cell's vertex u, or joined to it by an edge.
   */
  struct Rings
  {
    std::vector<std::size_t>   begin; // of a cell's list; one more than there are cells
    std::vector<unsigned int>  node;
    std::vector<unsigned char> touches;

    unsigned int size(const unsigned int cell) const { return begin[cell + 1] - begin[cell]; }
  };

  /**
   * The same for loops over registers: lists are filled up to whole ones of 8 by their first node, which touches
   * nothing there, and positions lie side by side for each axis.
   */
  template <int dim>
  struct RingLanes
  {
    std::vector<std::size_t>             begin; // of a cell's list, in nodes; multiples of 8
    std::vector<unsigned int>            node;
    std::vector<unsigned char>           touches;
    std::array<std::vector<double>, dim> x; // [length]
  };

  /**
   * A simplex mesh (segments, triangles, tetrahedra) as plain tables by local cell and local node, all that the hot
   * loops see of it. Barycentric coordinates of x in a cell with vertices x_0, ..., x_dim are
   * @f[ B_k = \sum_e (E^{-1})_{k-1,e} (x - x_0)_e , \quad B_0 = 1 - \sum_{k>0} B_k , \quad
   *     E = [x_1 - x_0, ..., x_{dim} - x_0] . @f]
   *
   * Throws nothing: what is wrong with a mesh is found by check_mesh(), before. Test: tests/mesh/tables.cc.
   */
  template <int dim>
  struct Mesh
  {
    static constexpr unsigned int missing   = static_cast<unsigned int>(-1);
    static constexpr unsigned int n_corners = dim + 1;

    using Vector      = std::array<double, dim>;
    using Corners     = std::array<unsigned int, n_corners>; // something for each vertex of a cell
    using Barycentric = std::array<double, n_corners>;

    /**
     * Sets all tables. Vertices may come in any orientation. Owners become 0 and the cells' numbers at their owner
     * those given here: a mesh in parts sets them itself, and the sizes of nodes whose cells are not all here.
     */
    void reinit(std::vector<Vector> positions, std::vector<Corners> cells);

    /**
     * Makes the moving least squares of all other nodes vanish on faces whose vertices are all held, as P1 does: where
     * conditions hold the nodes of a wall, its traction then acts on these alone. The vertices that are held no longer
     * count among those which other nodes touch.
     */
    void hold(const std::vector<char> &is_held);

    /**
     * A wall across an axis beyond which the mesh goes on as its mirror image. Beyond a slip wall velocities along the
     * axis are opposite to those of their images, beyond any other all components are.
     */
    struct Mirror
    {
      unsigned int      axis     = 0;
      bool              is_upper = false; // the mesh lies below it
      double            position = 0;     // [length]
      bool              slips    = false;
      std::vector<char> is_on    = {}; // whether a node lies on it, where the mesh ends there
    };

    /**
     * Completes the rings of cells at these walls by nodes beyond: images of the nodes joined to a vertex on a wall,
     * and where walls meet, images of images. The mesh ends at the walls as before, particles never come there. Test:
     * tests/mesh/mirrors.cc.
     */
    void mirror(const std::vector<Mirror> &mirrors);

    /**
     * The same where the mesh has a layer of cells beyond the walls: its nodes become images of those that lie where
     * they have their mirror images, whatever the cells. False where a node in the ring of one of the first `n_cells`
     * cells has none: its position is then in `missing_image`. Test: tests/mesh/mirrors.cc.
     */
    bool fold(const std::vector<Mirror> &mirrors, const unsigned int n_cells, Vector &missing_image);

    /** A node beyond mirrors. */
    struct Image
    {
      unsigned int  node;   // what it is an image of
      unsigned char beyond; // faces of a box along whose normals its velocity is opposite, as in Stencil
    };

    /** The node itself, or that of which it is an image. */
    unsigned int real(const unsigned int v) const { return v < n_nodes() ? v : images[v - n_nodes()].node; }

    /** A point at which no node counts that is not held has a share of this in each vertex of its cell. */
    static constexpr double least_share = 1e-9;

    bool has_held(const unsigned int cell) const { return !held.empty() && held[cell] != 0; }

    unsigned int n_nodes() const { return position.size() - images.size(); }
    unsigned int n_cells() const { return nodes.size(); }

    std::vector<Vector> position; // of the nodes, then of the images [length]
    std::vector<Image>  images;
    std::vector<double> size; // of a node: the longest edge at it [length]

    std::vector<Corners>      nodes;
    std::vector<Corners>      neighbours; // the cell beyond the face opposite to a vertex, or `missing`
    std::vector<unsigned int> owner;      // rank
    std::vector<unsigned int> number;     // of the cell at its owner
    Rings                     rings;
    RingLanes<dim>            ring_lanes;
    std::vector<char>         held; // whether a cell has vertices that are held; empty: none has

    double longest_edge = 0; // [length]

    /** Barycentric coordinates of x; those outside a cell are negative somewhere. */
    Barycentric barycentric(const unsigned int cell, const double *x) const
    {
      const Vector &origin = position[nodes[cell][0]];
      Barycentric   B;
      B[0] = 1;
      for (unsigned int k = 0; k < dim; ++k)
      {
        B[k + 1] = 0;
        for (unsigned int e = 0; e < dim; ++e)
          B[k + 1] += inverse_edges[cell][k][e] * (x[e] - origin[e]);
        B[0] -= B[k + 1];
      }
      return B;
    }

    /** Their gradients [1/length]. */
    std::array<Vector, n_corners> gradients(const unsigned int cell) const
    {
      std::array<Vector, n_corners> gradient;
      for (unsigned int e = 0; e < dim; ++e)
      {
        gradient[0][e] = 0;
        for (unsigned int k = 0; k < dim; ++k)
        {
          gradient[k + 1][e] = inverse_edges[cell][k][e];
          gradient[0][e] -= gradient[k + 1][e];
        }
      }
      return gradient;
    }

  private:
    void find_inverse_edges();
    void find_neighbours();
    void find_rings();
    void fill_ring_lanes();
    void find_sizes();

    std::vector<std::array<Vector, dim>> inverse_edges; // E^-1 [1/length]
  };
} // namespace Talus
