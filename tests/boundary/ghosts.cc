#include "../setup.h"

#include <random>

using namespace Test;
using namespace dealii;

namespace
{
  /** A box with ghosts whose nodes have random masses, momenta and forces; the same on any number of ranks. */
  template <int dim>
  class RandomNodes
  {
  public:
    using Index  = typename Lattice<dim>::Index;
    using Fields = NodalFields<dim>;

    static constexpr int n = dim == 2 ? 14 : 6; // cells per axis

    explicit RandomNodes(const std::string &conditions, const bool has_forces = true) :
      setup(section("Grid", set("Spacing", "1") + set("Upper corner", coordinates<dim>({{n, n, n}}))) +
            kernel_text("quadratic B-spline", "ghost nodes") + conditions)
    {
      Index first;
      first.fill(-1);
      setup.grid.clear();
      setup.walls.clear();
      std::mt19937 random(5);
      for_each_index(first, n + 3, [&](const Index &index) {
        std::array<double, 8> numbers;
        for (double &number : numbers)
          number = std::uniform_real_distribution<>(-1, 1)(random);
        numbers[Fields::mass] = 1.1 + numbers[Fields::mass];
        for (unsigned int c = 0; c < dim && !has_forces; ++c)
          numbers[Fields::force + c] = 0;
        if (is_mine(index))
          std::copy_n(numbers.begin(), 1 + 2 * dim, node(index));
        before[index] = numbers;
      });
    }

    /** Whether this rank owns the node or ghost. */
    bool is_mine(const Index &index) const
    {
      Index inside = index;
      for (int &i : inside)
        i = std::min(std::max(i, 0), n);
      return setup.grid.lattice.node_at(inside) < setup.grid.fields.n_owned();
    }

    double *node(const Index &index) { return setup.grid.fields.at_place(setup.grid.lattice.table_index(index)); }

    /** What the node has lost [momentum]. */
    double loss(const Index &index, const unsigned int c, const double dt)
    {
      const auto &old = before[index];
      return old[Fields::momentum + c] + dt * old[Fields::force + c] - old[0] * node(index)[Fields::velocity + c];
    }

    Setup<dim>                             setup;
    std::map<Index, std::array<double, 8>> before;
  };

  template <int dim>
  std::string walls(const double mu)
  {
    const auto        faces = [](const std::string &ids) { return set("Boundary ids", ids); };
    const std::string rough = set("Type", "friction") + set("Friction coefficient", std::to_string(mu)) +
                              set("Wall velocity", dim == 2 ? "0.1*t; 0.3" : "0.1*t; 0.3; 1");
    return section("Conditions",
                   set("Names", "smooth, rough, fixed, held") + section("smooth", set("Type", "slip") + faces("0")) +
                     section("rough", rough + faces("2, 3") + set("Half spaces", dim == 2 ? "x >= 12.5" : "x >= 4.5")) +
                     section("fixed", set("Type", "no-slip") + faces(dim == 2 ? "1" : "1, 4")) +
                     section("held", set("Type", "velocity") + set("Velocity", dim == 2 ? "1; -t*y" : "1; -t*y; 0") +
                                       set("Components", "y") + set("Lower corner", coordinates<dim>({{-1, 1.9, 0}})) +
                                       set("Upper corner", coordinates<dim>({{3, 4.1, 9}}))));
  }

  /** Friction at a node of the lower face in y, away from others: what its line has lost, against the law. */
  template <int dim>
  void look_at_contact(RandomNodes<dim> &nodes, const typename Lattice<dim>::Index &w, const double mu, const double dt,
                       double &error, std::array<unsigned int, 3> &counts)
  {
    const double wall[] = {0.07, 0.3, 1};
    auto         g      = w;
    g[1]                = -1;
    Tensor<1, dim> J, slip;
    for (unsigned int c = 0; c < dim; ++c)
    {
      J[c]    = nodes.loss(w, c, dt) + 2 * nodes.loss(g, c, dt);
      slip[c] = nodes.node(w)[NodalFields<dim>::velocity + c] - wall[c];
    }
    const double limit = -mu * J[1]; // outward is -y
    if (J.norm() < 1e-12)
    {
      ++counts[0]; // free, and leaves
      raise(error, std::min(0., slip[1]));
      return;
    }
    raise(error, slip[1]);
    raise(error, std::max(0., J[1]));
    J[1] = 0;
    if (slip.norm() < 1e-12)
    {
      ++counts[1]; // sticks
      raise(error, std::max(0., J.norm() - limit));
      return;
    }
    ++counts[2]; // slides: the wall takes what it can against the motion
    raise(error, J.norm() - limit);
    raise(error, std::min(0., J * slip));
  }
} // namespace

/** What all conditions take is what the body loses; friction keeps to its law; nothing is gained at walls at rest. */
template <int dim>
void ghosts()
{
  const double dt = 0.1;
  for (const double mu : {0., 0.4, 9.})
  {
    const std::string name = "mu = " + std::to_string(mu).substr(0, 3);
    RandomNodes<dim>  nodes(walls<dim>(mu));
    nodes.setup.move_nodes(0.6, dt);

    Tensor<1, dim>              loss, reaction;
    double                      error = 0, magnitude = 0;
    std::array<unsigned int, 3> counts{};
    for (const auto &[index, old] : nodes.before)
    {
      if (!nodes.is_mine(index))
        continue;
      for (unsigned int c = 0; c < dim; ++c)
      {
        loss[c] += nodes.loss(index, c, dt);
        magnitude += std::abs(nodes.loss(index, c, dt));
      }
      if (index[1] == 0 && index[0] >= 2 && index[0] <= nodes.n - 2 &&
          (dim == 2 || (index[dim - 1] >= 2 && index[dim - 1] <= 4)))
        look_at_contact(nodes, index, mu, dt, error, counts);
    }
    for (const auto &condition : nodes.setup.boundary.conditions)
      reaction += condition->reaction;
    // The round-off of as many terms, if it is random.
    const double bound = std::sqrt(nodes.before.size()) * std::numeric_limits<double>::epsilon() * sum(magnitude);
    for (unsigned int c = 0; c < dim; ++c)
      check(name + ": loss - reaction", sum(loss[c]) - dt * sum(reaction[c]), bound);
    check(name + ": the law of friction", error, 1e-12);
    check_true(name + ": some are free", sum(counts[0]) > 0);
    check_true(name + ": some slide or stick", sum(mu > 1 ? counts[1] : counts[2]) > 0);

    for (auto &condition : nodes.setup.boundary.conditions)
      raise(error, std::isfinite(condition->work) ? 0. : 1.);
    check(name + ": work", error, 1e-12);
  }
}

/** Local damping takes energy and nothing but the momentum that it says; held components it leaves alone. */
template <int dim>
void ghosts_damped()
{
  const double     dt = 0.1, alpha = 0.6;
  const auto       text = section("Conditions", set("Names", "smooth") +
                                                  section("smooth", set("Type", "slip") + set("Boundary ids", "0, 2")));
  RandomNodes<dim> plain(text), damped(text);
  damped.setup.boundary.damping.factor = alpha;
  plain.setup.move_nodes(0., dt);
  damped.setup.move_nodes(0., dt);
  using Fields = NodalFields<dim>;
  double error = 0, largest = 0;
  for (const auto &[index, old] : plain.before)
    if (plain.is_mine(index))
      for (unsigned int c = 0; c < dim; ++c)
      {
        bool is_far = true, is_held = index[c] == 0 && c < 2;
        for (unsigned int d = 0; d < dim; ++d)
          is_far = is_far && index[d] > 1 && index[d] < plain.n - 1;
        const double change = damped.node(index)[Fields::velocity + c] - plain.node(index)[Fields::velocity + c];
        raise(largest, change);
        if (is_far)
          raise(error, std::abs(change) - alpha * dt * std::abs(old[Fields::force + c]) / old[0]);
        if (is_held)
          raise(error, change);
      }
  check("changes", error, 1e-12);
  check_true("some", max(largest) > 1e-3);
  // The work of all nodes: the sum of m dv v with ghosts' masses and velocities, as rows are rows.
  double work = 0;
  for (const auto &[index, old] : plain.before)
    if (plain.is_mine(index))
      for (unsigned int c = 0; c < dim; ++c)
        work += old[0] * (damped.node(index)[Fields::velocity + c] - plain.node(index)[Fields::velocity + c]) *
                damped.node(index)[Fields::velocity + c];
  check("work", sum(work) - sum(damped.setup.boundary.damping.work), 1e-12);
}

/** An obstacle across walls, before and behind them: with what conditions take it is what the body loses. */
template <int dim>
void ghosts_and_obstacle()
{
  const double     dt = 0.1;
  RandomNodes<dim> nodes(
    walls<dim>(0.4) + section("Obstacles", set("Names", "bed") + section("bed", set("Formula", "0.3 * x + y - 3.3") +
                                                                                  set("Friction coefficient", "0.3") +
                                                                                  set("Rotation", "0.2 * t"))));
  nodes.setup.move_nodes(0.6, dt);
  Tensor<1, dim> loss, reaction, own;
  double         magnitude = 0;
  for (const auto &[index, old] : nodes.before)
    if (nodes.is_mine(index))
      for (unsigned int c = 0; c < dim; ++c)
      {
        loss[c] += nodes.loss(index, c, dt);
        magnitude += std::abs(nodes.loss(index, c, dt));
      }
  const double bound = std::sqrt(nodes.before.size()) * std::numeric_limits<double>::epsilon() * sum(magnitude);
  for (const auto &condition : nodes.setup.boundary.conditions)
    reaction += condition->reaction;
  own = nodes.setup.boundary.obstacles[0]->reaction;
  for (unsigned int c = 0; c < dim; ++c)
    check("loss - reactions", sum(loss[c]) - dt * sum(reaction[c] + own[c]), bound);
  check_true("the obstacle bears something", std::abs(sum(own[1])) > 0.1);
}

template void ghosts_and_obstacle<2>();
template void ghosts_and_obstacle<3>();
template void ghosts<2>();
template void ghosts<3>();
template void ghosts_damped<2>();
template void ghosts_damped<3>();
