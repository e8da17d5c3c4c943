#include "wall_box.h"

using namespace Test;
using namespace dealii;

namespace
{
  using Vector = std::vector<double>;

  struct Errors
  {
    double copies = 0, fill = 0, held = 0, increment = 0, residual = 0, impulse = 0, loss = 0, energy = 0, symmetry = 0;
  };

  /** What must hold after a step, whatever is held: all but the energy. */
  template <int dim>
  void look(WallBox<dim> &box, const double dt, const bool is_moving, Errors &errors)
  {
    const auto &dense = box.dense;
    raise(errors.copies, box.copy_error);
    for (unsigned int c = 0; c < dim; ++c)
    {
      const Vector &v = box.velocity[c];
      Vector        rest(dense.size);
      double        lost = 0, taken = 0;
      for (unsigned int i = 0; i < dense.size; ++i)
      {
        double filled = 0;
        for (unsigned int j = 0; j < dense.size; ++j)
          filled += dense.C[c][i][j] * v[j];
        raise(errors.fill, filled - v[i]);
        if (dense.is_real[i] && dense.held[i][c])
          raise(errors.held, v[i] - (is_moving ? box.v_h[c][i] : 0.));
        rest[i] = box.momentum[c][i] + dt * box.force[c][i] - box.mass[i] * v[i];
        lost += rest[i];
        if (box.mass[i] > 0)
          raise(errors.increment, v[i] - box.momentum[c][i] / box.mass[i] - box.increment[c][i]);
      }
      const Vector folded = dense.fold(c, rest);
      for (unsigned int i = 0; i < dense.size; ++i)
        if (dense.is_real[i])
        {
          if (!dense.held[i][c])
            raise(errors.residual, folded[i]);
          else
          {
            raise(errors.impulse, folded[i] - box.impulse[c][i]);
            taken += box.impulse[c][i];
          }
        }
      raise(errors.loss, lost - taken);
    }
  }

  /** Kinetic energy of a step without forces at walls at rest, and the map's symmetry in the norm of m. */
  template <int dim>
  void look_at_map(WallBox<dim> &box, Errors &errors)
  {
    const auto energy = [&](const std::vector<Vector> &a, const std::vector<Vector> &b) {
      double sum = 0;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int i = 0; i < box.dense.size; ++i)
          sum += box.mass[i] * a[c][i] * b[c][i];
      return sum;
    };
    std::vector<Vector> fields[2], images[2];
    for (unsigned int k = 0; k < 2; ++k)
    {
      fields[k] = box.v_h;
      for (unsigned int i = 0; i < box.dense.size; ++i)
      {
        for (unsigned int c = 0; c < dim; ++c)
          fields[k][c][i] = box.uniform(-1, 1);
        box.move(i, [&](const unsigned int c, const unsigned int i) { return fields[k][c][i]; });
      }
      box.step(0., false);
      images[k] = box.velocity;
      raise(errors.energy, std::max(0., energy(images[k], images[k]) / energy(fields[k], fields[k]) - 1));
    }
    raise(errors.symmetry, energy(images[0], fields[1]) - energy(images[1], fields[0]));
  }

  /**
   * On every face held along its normal, the normal velocity of quadratic B-splines is that of the wall, also between
   * its last node and an edge: (v_g + v_q) / 8 + 3/4 v_w on each line across it, ghosts beside it included.
   */
  template <int dim>
  double leak(WallBox<dim> &box, const unsigned int seed)
  {
    const auto &dense = box.dense;
    const auto &n     = dense.n_cells;
    box.choose(seed, Kind::faces);
    box.fill(false, true);
    box.step(0.3, false);
    double error = 0;
    for (const auto &w : dense.nodes)
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (w[d] != 0 && w[d] != n[d])
          continue;
        auto inside = w;
        for (unsigned int e = 0; e < dim; ++e)
          inside[e] = e == d ? w[e] : std::min(std::max(w[e], 1), n[e] - 1);
        if (!dense.held[dense.number(inside)][d])
          continue;
        auto g = w, q = w;
        g[d]          = w[d] == 0 ? -1 : n[d] + 1;
        q[d]          = w[d] == 0 ? 1 : n[d] - 1;
        const auto &v = box.velocity[d];
        raise(error, (v[dense.number(g)] + v[dense.number(q)]) / 8 + 0.75 * v[dense.number(w)]);
      }
    return error;
  }

  /** v = a + A x where the conditions allow it: kept to round-off. */
  template <int dim>
  double linear_error(WallBox<dim> &box, const unsigned int seed, const Kind kind)
  {
    box.choose(seed, kind);
    Tensor<2, dim> A;
    Tensor<1, dim> a;
    for (unsigned int c = 0; c < dim; ++c)
    {
      a[c] = box.uniform(-1, 1);
      for (unsigned int d = 0; d < dim; ++d)
        A[c][d] = kind == Kind::slip && c != d ? 0. : box.uniform(-1, 1); // no d v_t / d n where walls slip
    }
    const auto v = [&](const unsigned int c, const unsigned int i) {
      double sum = a[c];
      for (unsigned int d = 0; d < dim; ++d)
        sum += A[c][d] * box.dense.nodes[i][d];
      return sum;
    };
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < box.dense.size; ++i)
        box.v_h[c][i] = v(c, i);
    box.fill(false, false);
    for (double &m : box.mass)
      m += 0.1;
    for (unsigned int i = 0; i < box.dense.size; ++i)
      box.move(i, v);
    box.step(0., true);
    double error = 0;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < box.dense.size; ++i)
        raise(error, box.velocity[c][i] - v(c, i));
    return error;
  }
} // namespace

/** Random patterns of held, slipping, moving and open nodes of the faces, and of held nodes inside. */
template <int dim>
void walls()
{
  const std::vector<std::array<int, 3>> boxes =
    dim == 2 ? std::vector<std::array<int, 3>>{{{1, 1, 0}}, {{1, 4, 0}}, {{2, 2, 0}}, {{3, 1, 0}}, {{2, 5, 0}},
                                               {{3, 3, 0}}, {{5, 4, 0}}, {{4, 2, 0}}, {{5, 5, 0}}} :
               std::vector<std::array<int, 3>>{{{1, 1, 1}}, {{2, 1, 3}}, {{2, 2, 2}}, {{3, 2, 1}},
                                               {{1, 4, 1}}, {{3, 3, 3}}, {{2, 4, 3}}};
  Errors errors;
  double linear = 0, leaks = 0;
  for (const auto &cells : boxes)
  {
    WallBox<dim> box(cells);
    for (unsigned int k = 0; k < (dim == 2 ? 60 : 25); ++k)
    {
      box.choose(k + 1, Kind::any);
      box.fill(k % 2 == 0, true);
      box.step(0.3, true);
      look(box, 0.3, true, errors);
      if (k % 5 == 0)
        look_at_map(box, errors);
    }
    for (unsigned int k = 0; k < 10; ++k)
      for (const Kind kind : {Kind::sticky, Kind::slip})
        raise(linear, linear_error(box, k, kind));
  }
  for (const auto &cells : dim == 2 ? std::vector<std::array<int, 3>>{{{3, 4, 0}}, {{5, 5, 0}}} :
                                      std::vector<std::array<int, 3>>{{{3, 3, 3}}, {{4, 3, 3}}})
  {
    WallBox<dim> box(cells);
    for (unsigned int k = 0; k < 30; ++k)
      raise(leaks, leak(box, k));
  }
  check("normal velocity on walls", leaks, 1e-12);
  check("the same on all ranks", errors.copies, 1e-13);
  check("ghosts are rows of real nodes", errors.fill, 1e-12);
  check("held velocities", errors.held, 1e-15);
  check("increments", errors.increment, 1e-12);
  check("residual of free unknowns", errors.residual, 1e-12);
  check("impulse of each held component", errors.impulse, 1e-12);
  check("loss - reaction", errors.loss, 1e-12);
  check("growth of energy", errors.energy, 1e-12);
  check("symmetry in the norm of m", errors.symmetry, 1e-12);
  check("linear fields", linear, 1e-13);
}

template void walls<2>();
template void walls<3>();
