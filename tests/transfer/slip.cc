#include "slip.h"

using namespace Test;
using namespace dealii;

namespace
{
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
} // namespace

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

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(slip_conservation)
INSTANTIATE(projection_definition)
INSTANTIATE(projection_elsewhere)
