#include <talus/kernels/mesh/c1_partition.h>

namespace Talus
{
  namespace
  {
    /** G_jk = grad B_j . grad B_k, of n vertices. */
    template <std::size_t n>
    using Gram = std::array<std::array<double, n>, n>;

    template <std::size_t n>
    double lambda(const Gram<n> &G, const unsigned int a, const unsigned int j)
    {
      return -G[j][a] / G[a][a];
    }

    void set(const Gram<2> &, FootCoordinates<1> &) {}

    void set(const Gram<3> &G, FootCoordinates<2> &feet)
    {
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int j = 0; j < 3; ++j)
          feet.lambda[a][j] = lambda(G, a, j);
    }

    void set(const Gram<4> &G, FootCoordinates<3> &feet)
    {
      for (unsigned int a = 0; a < 4; ++a)
      {
        const auto outer = [a](const unsigned int j) { return (a + 1 + j) % 4; };
        // Within the face the gradients lose their part along its normal grad B_a.
        Gram<3> in_face;
        for (unsigned int j = 0; j < 3; ++j)
        {
          feet.lambda[a][j] = lambda(G, a, outer(j));
          for (unsigned int k = 0; k < 3; ++k)
            in_face[j][k] = G[outer(j)][outer(k)] - G[outer(j)][a] * G[a][outer(k)] / G[a][a];
        }
        for (unsigned int b = 0; b < 3; ++b)
          for (unsigned int j = 0; j < 3; ++j)
            feet.face_lambda[a][b][j] = lambda(in_face, b, j);
      }
    }
  } // namespace

  template <int dim>
  std::vector<FootCoordinates<dim>> foot_coordinates(const Mesh<dim> &mesh)
  {
    std::vector<FootCoordinates<dim>> feet(mesh.n_cells());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      const auto    gradient = mesh.gradients(c);
      Gram<dim + 1> gram{};
      for (unsigned int j = 0; j <= dim; ++j)
        for (unsigned int k = 0; k <= dim; ++k)
          for (unsigned int d = 0; d < dim; ++d)
            gram[j][k] += gradient[j][d] * gradient[k][d];
      set(gram, feet[c]);
    }
    return feet;
  }

  template std::vector<FootCoordinates<1>> foot_coordinates(const Mesh<1> &);
  template std::vector<FootCoordinates<2>> foot_coordinates(const Mesh<2> &);
  template std::vector<FootCoordinates<3>> foot_coordinates(const Mesh<3> &);
} // namespace Talus
