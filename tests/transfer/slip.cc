#include <talus/steppers/explicit_step.h>

#include "transfer.h"

using namespace Test;
using namespace dealii;

/** Slip walls: the projection of the affine field, and the mirror. */
namespace
{
  const std::string project = set("Slip projection", "true");

  /** Conditions of one type each on some faces. */
  std::string walls(const std::vector<std::pair<std::string, std::string>> &list)
  {
    std::string names, content;
    for (const auto &[type, faces] : list)
    {
      const std::string name = "w" + std::to_string(content.size());
      names += (names.empty() ? "" : ", ") + name;
      content += section(name, set("Type", type) + faces);
    }
    return section("Conditions", set("Names", names) + content);
  }

  std::string faces(const std::string &ids) { return set("Boundary ids", ids); }

  template <int dim>
  std::string slip_in_y()
  {
    return walls({{"slip", faces("2, 3")}});
  }

  template <int dim>
  std::string small_box(const std::string &treatment, const std::string &transfer, const std::string &more)
  {
    return full_box<dim>("quadratic B-spline", treatment, transfer, more);
  }

  /** Greatest difference of the nodes' numbers of two set-ups of one grid, relative to the largest of their kind. */
  template <int dim>
  double difference(const Setup<dim> &a, const Setup<dim> &b)
  {
    double largest = 0, result = 0;
    for (unsigned int i = 0; i < a.grid.fields.n_owned(); ++i)
      for (unsigned int lane = 0; lane < NodalFields<dim>::stride; ++lane)
      {
        largest = std::max(largest, std::abs(a.grid.fields[i][lane]));
        raise(result, a.grid.fields[i][lane] - b.grid.fields[i][lane]);
      }
    return max(result) / max(largest);
  }

  /**
   * The same growth in one dimension, from dense matrices alone: particles at h/4, 3h/4, ... with quadratic B-splines,
   * of which the last half cell at either wall has two nodes, so that reproduction of linear functions leaves one
   * choice. In units of h; the gradient of the first row after n_steps transfers with the projection at the lower wall.
   */
  double projected_growth(const bool is_apic, const unsigned int n_cells, const unsigned int n_steps)
  {
    const unsigned int  n_rows = 2 * n_cells, n_nodes = n_cells + 1;
    FullMatrix<double>  weight(n_rows, n_nodes), gradient(n_rows, n_nodes), offset(n_rows, n_nodes);
    std::vector<double> v(n_rows), slope(n_rows), D(n_rows, 0.), mass(n_nodes, 0.), v_node(n_nodes);
    for (unsigned int p = 0; p < n_rows; ++p)
    {
      const double       y = 0.5 * p + 0.25;
      const unsigned int c = static_cast<unsigned int>(y + 0.5);
      const double       d = y - c;
      if (c == 0 || c == n_cells)
      {
        const unsigned int first = c == 0 ? 0 : c - 1;
        weight(p, first) = 1 - (y - first), weight(p, first + 1) = y - first;
        gradient(p, first) = -1, gradient(p, first + 1) = 1;
      }
      else
      {
        weight(p, c - 1) = (0.5 - d) * (0.5 - d) / 2, weight(p, c) = 0.75 - d * d;
        weight(p, c + 1)   = (0.5 + d) * (0.5 + d) / 2;
        gradient(p, c - 1) = d - 0.5, gradient(p, c) = -2 * d, gradient(p, c + 1) = d + 0.5;
      }
      v[p] = y * y, slope[p] = 2 * y;
      for (unsigned int i = 0; i < n_nodes; ++i)
      {
        offset(p, i) = i - y;
        D[p] += weight(p, i) * offset(p, i) * offset(p, i);
        mass[i] += weight(p, i);
      }
    }
    for (unsigned int n = 0; n < n_steps; ++n)
    {
      std::fill(v_node.begin(), v_node.end(), 0.);
      for (unsigned int p = 0; p < n_rows; ++p)
        for (unsigned int i = 0; i < n_nodes; ++i)
          v_node[i] += weight(p, i) * (v[p] + (p == 0 ? 0. : slope[p] * offset(p, i))) / mass[i];
      for (unsigned int p = 0; p < n_rows; ++p)
      {
        v[p] = slope[p] = 0;
        for (unsigned int i = 0; i < n_nodes; ++i)
        {
          v[p] += weight(p, i) * v_node[i];
          slope[p] += (is_apic ? weight(p, i) * offset(p, i) / D[p] : gradient(p, i)) * v_node[i];
        }
      }
    }
    return v_node[1] - v_node[0];
  }
} // namespace

/**
 * Frozen particles below a slip wall carry v_x = y^2. Next to the wall d v_x / d y is h / 2 on the first row, and stays
 * so when it is transferred with a cure; without one the difference of the last two nodes feeds itself.
 */
template <int dim>
void wall_shear()
{
  const double h = 0.1;
  // The other faces are far away, or uniform in x and z.
  const auto grow = [&](const std::string &treatment, const std::string &transfer, const std::string &more,
                        const unsigned int n_steps) {
    Setup<dim> setup(section("Grid", set("Spacing", "0.1") + set("Upper corner", dim == 2 ? "0.3, 4" : "0.2, 4, 0.2")) +
                     kernel_text("quadratic B-spline", treatment) + transfer_text(transfer, more) +
                     walls({{"slip", faces("2")}}) +
                     body_text(set("Upper corner", dim == 2 ? "0.3, 4" : "0.2, 4, 0.2")));
    setup.fill(setup.particles.velocity, [&](const unsigned int p, const unsigned int c) {
      return c == 0 ? std::pow(setup.position(p)[1], 2) : 0.;
    });
    setup.fill(setup.particles.grad_v,
               [&](const unsigned int p, const unsigned int c) { return c == 1 ? 2 * setup.position(p)[1] : 0.; });
    setup.boundary.mark_slip_walls(0., setup.particles.n_stencil_nodes, setup.grid);
    setup.transfer->initialize(*setup.kernel, setup.particles);
    for (unsigned int n = 0; n < n_steps; ++n)
      setup.step(0.);
    double sum_of_row = 0, count = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      if (setup.position(p)[1] < h / 2)
      {
        sum_of_row += setup.particles.component(setup.particles.grad_v, 1)[p];
        ++count;
      }
    return sum(sum_of_row) / sum(count) / h;
  };
  const auto steps = dim == 2 ? std::vector<unsigned int>{10, 100, 1000} : std::vector<unsigned int>{10, 100};
  for (const std::string transfer : {"TPIC", "APIC"})
  {
    if (dim == 2 && transfer == "TPIC")
    {
      check_range("WLS, 1 step", grow("WLS", transfer, "", 1), 0.9, 1.1);
      check_range("WLS, 10 steps", grow("WLS", transfer, "", 10), 1.9, 2.1);
      check_range("WLS, 100 steps", grow("WLS", transfer, "", 100), 3.7, 4.1);
      check_range("WLS, 1000 steps", grow("WLS", transfer, "", 1000), 6.5, 7.5);
    }
    for (const std::string treatment : {"WLS", "WLS separable"})
    {
      const std::string name   = transfer + ", " + treatment + ", projection, steps: ";
      double            before = grow(treatment, transfer, project, 1);
      // By hand: v_0 = -.15074 h^2, v_1 = .72782 h^2.
      check(name + "1", before - 0.87856, 1e-4);
      for (const unsigned int n : steps)
      {
        const double now = grow(treatment, transfer, project, n);
        check_range(name + std::to_string(n), now, 0.5, before);
        if (treatment == "WLS separable") // whose corners are products, so that nothing depends on x
          check(name + std::to_string(n) + ", 1D", now - projected_growth(transfer == "APIC", 40, n), 1e-9);
        before = now;
      }
    }
    for (const unsigned int n : steps)
      check_range(transfer + ", mirror, steps: " + std::to_string(n), grow("mirror", transfer, "", n), 0.4999, 0.5001);
  }
}

/** Mass and momentum on the grid and after the step; at mirrors only along them, and the force across is accounted for.
 */
template <int dim>
void slip_conservation()
{
  for (const std::string transfer : {"FLIP", "PIC", "APIC", "TPIC"})
    for (const std::string treatment : {"WLS", "WLS separable", "mirror"})
    {
      const bool is_affine = transfer == "APIC" || transfer == "TPIC", is_mirror = treatment == "mirror";
      if (!is_affine && !is_mirror)
        continue;
      Setup<dim> setup(small_box<dim>(treatment, transfer, is_mirror || !is_affine ? "" : project) + slip_in_y<dim>());
      setup.accelerate(dim == 2 ? "0.4; -0.7" : "0.4; -0.7; 0.2");
      randomize_motion(setup);
      setup.randomize(setup.particles.stress, 5);

      double         m = 0, scale = 0, weight = 0;
      Tensor<1, dim> before;
      for (unsigned int p = 0; p < setup.particles.size(); ++p)
      {
        const double m_p = setup.particles.component(setup.particles.mass, 0)[p];
        m += m_p;
        before += m_p * velocity(setup, p);
        scale += m_p * velocity(setup, p).norm();
      }
      m = sum(m), scale = sum(scale), weight = -0.7 * m, before = Utilities::MPI::sum(before, MPI_COMM_WORLD);

      setup.boundary.mark_slip_walls(0., setup.particles.n_stencil_nodes, setup.grid);
      setup.scatter();
      setup.grid.fields.add_copies_to_owners();
      double         mass = 0, force = 0;
      Tensor<1, dim> momentum;
      for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
      {
        mass += setup.grid.fields[i][NodalFields<dim>::mass];
        momentum += node_vector(setup, i, NodalFields<dim>::momentum);
        force += setup.grid.fields[i][NodalFields<dim>::force + 1];
      }
      force += setup.grid.fields.mirrored_force[2] + setup.grid.fields.mirrored_force[3];
      momentum               = Utilities::MPI::sum(momentum, MPI_COMM_WORLD);
      const std::string name = transfer + ", " + treatment;
      Tensor<1, dim>    lost = momentum - before;
      if (is_mirror)
        lost[1] = 0;
      check(name + ": mass", sum(mass) / m - 1, 1e-13);
      check(name + ": momentum on the grid", lost.norm() / scale, 1e-13);
      // Internal forces add up to nothing, so that nodes and mirrors bear the weight.
      check(name + ": force on the grid and the mirrors", (sum(force) - weight) / weight, 1e-11);

      setup.step(0.);
      Tensor<1, dim> after;
      for (unsigned int p = 0; p < setup.particles.size(); ++p)
        after += setup.particles.component(setup.particles.mass, 0)[p] * velocity(setup, p);
      lost    = Utilities::MPI::sum(after, MPI_COMM_WORLD) - before;
      lost[1] = 0;
      check(name + ": momentum along the walls", lost.norm() / scale, 1e-13);
    }
}

/**
 * The scatter of TPIC with L' = L - (I - n n^T) L n n^T of the particles closer to a slip wall than half a spacing,
 * computed here by outer products, n after n.
 */
template <int dim>
void projection_definition()
{
  for (const std::string treatment : {"WLS", "WLS separable", "MLS"})
    for (const bool is_plain : {false, true})
    {
      // Slip on the lower x and upper y faces; the others are free or no-slip, which ends at the edges of the slip
      // walls.
      const std::string conditions = walls({{"slip", faces("0, 3")}, {"no-slip", faces("2")}});
      Setup<dim>        setup(small_box<dim>(treatment, "TPIC", project) + conditions);
      setup.transfer->is_plain = is_plain;
      randomize_motion(setup);
      setup.boundary.mark_slip_walls(0., setup.particles.n_stencil_nodes, setup.grid);
      setup.scatter();
      setup.grid.fields.add_copies_to_owners();

      Setup<dim> expected(small_box<dim>(treatment, "TPIC", "") + conditions);
      expected.grid.clear();
      randomize_motion(expected);
      for (unsigned int p = 0; p < expected.particles.size(); ++p)
      {
        const double m = expected.particles.component(expected.particles.mass, 0)[p];
        auto         L = matrix(expected, expected.particles.grad_v, p);
        const auto   x = expected.position(p);
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double c = expected.grid.lattice.coordinate(x[d], d);
          if (!(d == 0 ? c < 0.5 : c > expected.grid.lattice.n_cells[1] - 0.5))
            continue;
          Tensor<1, dim> normal;
          normal[d]              = d == 0 ? -1 : 1;
          const Tensor<2, dim> N = outer_product(normal, normal);
          Tensor<2, dim>       T = unit_symmetric_tensor<dim>();
          T -= N;
          L -= T * L * N;
        }
        const auto stencil = expected.stencil(p);
        for (unsigned int k = 0; k < stencil.size; ++k)
        {
          Tensor<1, dim> offset;
          for (unsigned int d = 0; d < dim; ++d)
            offset[d] = stencil.offset[d][k];
          const Tensor<1, dim> v    = velocity(expected, p) + L * offset;
          double              *node = expected.grid.fields.at_place(stencil.place[k]);
          node[0] += m * stencil.weight[k];
          for (unsigned int d = 0; d < dim; ++d)
            node[NodalFields<dim>::momentum + d] += m * stencil.weight[k] * v[d];
        }
      }
      expected.grid.fields.add_copies_to_owners();
      // Forces are zero in both.
      check(treatment + (is_plain ? ", plain" : ", batched"), difference(setup, expected), 1e-13);
    }
}

/** Nothing changes at walls of other kinds, where a slip wall is held by something else, or out of its time. */
template <int dim>
void projection_elsewhere()
{
  const std::string all = dim == 2 ? "0, 1, 2, 3" : "0, 1, 2, 3, 4, 5";
  const std::string box =
    set("Lower corner", coordinates<dim>({{-9, -9, -9}})) + set("Upper corner", coordinates<dim>({{9, 9, 9}}));
  const auto change = [&](const std::string &conditions, const std::string &transfer) {
    Setup<dim> with(small_box<dim>("WLS", transfer, project) + conditions);
    Setup<dim> without(small_box<dim>("WLS", transfer, "") + conditions);
    for (Setup<dim> *setup : {&with, &without})
    {
      randomize_motion(*setup);
      setup->boundary.mark_slip_walls(1., setup->particles.n_stencil_nodes, setup->grid);
      setup->scatter();
      setup->grid.fields.add_copies_to_owners();
    }
    return difference(with, without);
  };
  for (const std::string transfer : {"APIC", "TPIC"})
  {
    for (const std::string type : {"no-slip", "friction", "velocity"})
      check(transfer + ", " + type, change(walls({{type, faces(all)}}), transfer), 1e-300);
    check(transfer + ", no wall", change("", transfer), 1e-300);
    check(transfer + ", no-slip before slip", change(walls({{"no-slip", faces(all)}, {"slip", faces(all)}}), transfer),
          1e-300);
    check(transfer + ", slip in a box that is held", change(walls({{"slip", faces(all)}, {"no-slip", box}}), transfer),
          1e-300);
    check(transfer + ", slip that is over", change(walls({{"slip", faces(all) + set("End time", "0.5")}}), transfer),
          1e-300);
    check_true(transfer + ", slip", change(walls({{"slip", faces(all)}}), transfer) > 1e-3);
    check_true(transfer + ", slip from now on",
               change(walls({{"slip", faces(all) + set("Start time", "0.5")}}), transfer) > 1e-3);
  }
}

/**
 * Half of a symmetric body with a mirror moves as half of the whole body does. Not with FLIP: the nodes on the mirror
 * know the momentum of one side alone before the condition acts, and FLIP gathers the change.
 */
template <int dim>
void mirror_and_whole()
{
  for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"})
    for (const std::string transfer : {"PIC", "APIC", "TPIC"})
      for (const unsigned int axis : {0u, 1u})
      {
        // The plane is x_axis = 0; the half with a mirror is above, or below where it meets the other face of its axis.
        const bool is_above = axis == 0;
        const auto box      = [&](const double lower, const double upper) {
          std::array<double, 3> a = {{0, 0, 0}}, b = {{0.5, 0.5, 0.5}};
          a[axis] = lower, b[axis] = upper;
          return section("Grid", set("Lower corner", coordinates<dim>(a)) + set("Upper corner", coordinates<dim>(b)) +
                                        set("Spacing", "0.125")) +
                 kernel_text(kernel, "mirror") + transfer_text(transfer) +
                 body_text(set("Lower corner", coordinates<dim>(a)) + set("Upper corner", coordinates<dim>(b)));
        };
        Setup<dim> half(box(is_above ? 0 : -0.5, is_above ? 0.5 : 0) +
                        walls({{"slip", faces(std::to_string(2 * axis + (is_above ? 0 : 1)))}}));
        Setup<dim> whole(box(-0.5, 0.5));

        // What points along the normal is odd, the rest even; so are stress and gradient, entry by entry.
        const auto wave = [&](Setup<dim> &setup, const unsigned int p, const unsigned int c, const bool is_odd) {
          auto         x    = setup.position(p);
          const double side = x[axis] < 0 ? -1 : 1;
          x[axis]           = std::abs(x[axis]);
          double phase      = 1. + c;
          for (unsigned int d = 0; d < dim; ++d)
            phase += (9. + 4 * d) * x[d];
          return (is_odd ? side : 1.) * std::sin(phase);
        };
        for (Setup<dim> *setup : {&half, &whole})
        {
          auto &particles = setup->particles;
          setup->fill(particles.velocity,
                      [&](const unsigned int p, const unsigned int c) { return wave(*setup, p, c, c == axis); });
          setup->fill(particles.grad_v, [&](const unsigned int p, const unsigned int c) {
            return wave(*setup, p, c + 3, (c / dim == axis) != (c % dim == axis));
          });
          setup->fill(particles.stress, [&](const unsigned int p, const unsigned int c) {
            const unsigned int i = c < 3 ? c : (c == 5 ? 1 : 0), j = c < 3 ? c : (c == 3 ? 1 : 2);
            return wave(*setup, p, c + 11, (i == axis) != (j == axis));
          });
          setup->boundary.mark_slip_walls(0., particles.n_stencil_nodes, setup->grid);
          setup->transfer->initialize(*setup->kernel, particles);
          const double dt = 5e-3;
          for (unsigned int n = 0; n < 5; ++n)
          {
            setup->step(dt, n * dt);
            update_stress(particles, setup->materials, dt);
            particles.relocate();
            if (max(particles.needs_synchronise) > 0)
              particles.migrate();
          }
        }
        // The same sums over all particles of a half, of functions that tell them apart.
        const auto sums = [&](Setup<dim> &setup) {
          std::vector<double> result;
          for (const unsigned int field :
               {setup.particles.position, setup.particles.velocity, setup.particles.grad_v, setup.particles.stress})
            for (unsigned int c = 0; c < setup.particles.fields[field].n_components; ++c)
              for (const double q : {0., 3., 7.})
              {
                double value = 0;
                for (unsigned int p = 0; p < setup.particles.size(); ++p)
                {
                  const auto X = Point<dim>(setup.particles.vector(setup.particles.initial_position, p));
                  if ((X[axis] > 0) == is_above)
                    value +=
                      setup.particles.component(field, c)[p] * std::cos(q * X[0] + 2 * q * X[1] + q * X[dim - 1]);
                }
                result.push_back(sum(value));
              }
          return result;
        };
        const auto a = sums(half), b = sums(whole);
        double     error = 0, largest = 0;
        for (unsigned int i = 0; i < a.size(); ++i)
        {
          raise(error, a[i] - b[i]);
          largest = std::max(largest, std::abs(b[i]));
        }
        check(transfer + ", " + kernel + ", normal " + "xy"[axis], error / largest, 1e-12);
      }
}

/** A uniform pressure in a box of mirrors: each face bears pressure times area, by its nodes and by mirrored forces. */
template <int dim>
void mirror_reaction()
{
  for (const std::string kernel : {"quadratic B-spline", "cubic B-spline", "uGIMP"})
    for (const bool is_plain : {false, true})
      for (const unsigned int id : {2u, 3u})
      {
        const std::string others = dim == 2 ? "0, 1" : "0, 1, 4, 5";
        Setup<dim>        setup(
                 section("Grid", set("Cells", dim == 2 ? "6, 5" : "6, 5, 4")) + kernel_text(kernel, "mirror") +
                 transfer_text("TPIC") + body_text("") +
                 walls(
                   {{"slip", faces(std::to_string(id))}, {"slip", faces(std::to_string(5 - id))}, {"slip", faces(others)}}));
        setup.transfer->is_plain = is_plain;
        setup.fill(setup.particles.stress, [](unsigned int, const unsigned int c) { return c < 3 ? -2. : 0.; });
        setup.step(1e-3);
        const double reaction = sum(setup.boundary.conditions[0]->reaction[1]);
        check(kernel + (is_plain ? ", plain" : ", batched") + ", face " + std::to_string(id),
              reaction - (id == 2 ? -2. : 2.), 1e-12);
        check("  nodal force", sum(setup.boundary.conditions[0]->nodal_force[1]) - reaction, 1e-12);
        double v = 0;
        for (unsigned int p = 0; p < setup.particles.size(); ++p)
          raise(v, velocity(setup, p).norm());
        check("  nothing moves", max(v), 1e-12);
      }
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(wall_shear)
INSTANTIATE(slip_conservation)
INSTANTIATE(projection_definition)
INSTANTIATE(projection_elsewhere)
INSTANTIATE(mirror_and_whole)
INSTANTIATE(mirror_reaction)
