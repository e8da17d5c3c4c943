#include <talus/boundary/obstacle.h>
#include <talus/core/coordinates.h>
#include <talus/core/exceptions.h>

#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <cmath>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Obstacle<dim>::Obstacle(Parameters &parameters, const std::string &name) :
    ParameterAcceptor("/Obstacles/" + name), name(name),
    surface(parameters.make<ContactSurface<dim>>("/Obstacles/" + name, "Surface", "formula", "Its shape.")),
    displacement_text(dim == 2 ? "0; 0" : "0; 0; 0")
  {
    add_parameter("Friction coefficient", friction, "Greatest tangential over normal force, mu [1].", prm,
                  Patterns::Double());
    add_parameter("Account time", account_time,
                  "How long a node may use normal impulse that friction has not used, so that it sticks through "
                  "vibrations [time]; 0: that of the step alone.",
                  prm, Patterns::Double(0));
    add_parameter("Displacement", displacement_text,
                  "Where it has moved to [length]: functions of t, separated by ';'.");
    add_parameter("Rotation", rotation_text,
                  "Angle by which it has turned about the centre [radian]: a function of t.");
    add_parameter("Centre of rotation", centre,
                  "The point that it turns about, before it is displaced, and that its moment is about [length].", prm,
                  coordinates(dim));
    if (dim == 3)
      add_parameter("Axis of rotation", axis, "Direction of the axis that it turns about, through the centre.", prm,
                    coordinates(dim));
  }

  template <int dim>
  void Obstacle<dim>::parse_parameters(ParameterHandler &)
  {
    const auto check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    displacement.initialize(displacement_text, get_section_name(), "Displacement");
    rotation.initialize(rotation_text, get_section_name(), "Rotation");
    check(!displacement.depends_on_space(), "Displacement", "a rigid body moves as a whole: give functions of t.");
    check(!rotation.depends_on_space(), "Rotation", "a rigid body turns as a whole: give a function of t.");
    check(friction >= 0, "Friction coefficient", "it must not be negative; 0 is an obstacle without friction.");
    double length = 0;
    for (const double component : axis)
      length = std::hypot(length, component);
    check(length > 0, "Axis of rotation", "it has no direction. Give one, '0, 0, 1'.");
  }

  template <int dim>
  Placement<dim> Obstacle<dim>::placement(const double time) const
  {
    Placement<dim> result;
    result.centre       = to_point<dim>(centre);
    result.displacement = displacement.value({}, time);
    result.turn         = unit_symmetric_tensor<dim>();
    const double angle  = rotation.is_zero() ? 0 : rotation.value({}, time);
    if (angle != 0)
    {
      if constexpr (dim == 2)
        result.turn = Physics::Transformations::Rotations::rotation_matrix_2d(angle);
      else
      {
        const Point<3> direction = to_point<3>(axis);
        result.turn = Physics::Transformations::Rotations::rotation_matrix_3d(direction / direction.norm(), angle);
      }
    }
    return result;
  }

  template <int dim>
  void Obstacle<dim>::attach(const Grid<dim> &grid)
  {
    // Nodes of material that comes from outside lie no deeper than kernels reach.
    reach = 2.5 * grid.largest_spacing;
    surface->attach(grid);
    surface->create(reach);
    own_nodes.resize(grid.fields.n_owned());
    for (unsigned int i = 0; i < own_nodes.size(); ++i)
      own_nodes[i] = i;
    look_around(placement(0.), own_nodes, grid);
    if (!is_moved() && Utilities::MPI::sum(touched.size(), grid.communicator) == 0)
      throw EntryError(get_section_name(), "Surface",
                       "no node of the grid lies in the obstacle. Move it into the grid, or take a smaller spacing: it "
                       "must be two spacings thick at least.");
  }

  template <int dim>
  void Obstacle<dim>::look_around(const Placement<dim> &now, const std::vector<unsigned int> &nodes,
                                  const Grid<dim> &grid)
  {
    touched.clear();
    // One on the surface is in it, as those on faces of the grid are at its walls.
    const double tolerance = 1e-6 * grid.smallest_spacing;
    for (const unsigned int i : nodes)
    {
      const Point<dim> x     = grid.node_position(i);
      const auto       found = surface->signed_distance(now.back(x));
      if (!found || found->value > tolerance)
        continue;
      // At an edge the node has the mean normal of the sides, as if that were round; in a thin body it stands for both.
      Tensor<1, dim>              mean = found->normal;
      std::vector<Tensor<1, dim>> seen{found->normal}, normals;
      for (unsigned int d = 0; d < dim; ++d)
        for (const double side : {-0.6, 0.6})
        {
          Point<dim> beside = x;
          beside[d] += side * grid.spacing[d];
          const auto other = surface->signed_distance(now.back(beside));
          if (!other || std::any_of(seen.begin(), seen.end(), [&](const auto &n) { return n * other->normal > 0.9; }))
            continue;
          seen.push_back(other->normal);
          if (found->normal * other->normal > -0.5)
            mean += other->normal;
          else if (normals.empty())
            normals.push_back(now.turn * other->normal);
        }
      const double length = mean.norm();
      normals.push_back(now.turn * (length > 0.1 ? mean / length : found->normal));
      for (unsigned int k = 0; k < normals.size(); ++k)
        touched.push_back({i, k, normals[k]});
    }
  }

  template <int dim>
  double Obstacle<dim>::depth(const Point<dim> &x, const double time) const
  {
    const Point<dim> X     = placement(time).back(x);
    const auto       found = surface->signed_distance(X);
    return found ? -found->value : surface->contains(X) ? reach : 0.;
  }

  template <int dim>
  void Obstacle<dim>::apply(const double time, const double dt, const HeldComponents<dim> &held,
                            const Walls<dim> *walls, Grid<dim> &grid, const bool is_repeated)
  {
    using Fields      = NodalFields<dim>;
    const double step = dt > 0 ? dt : 1.;
    const auto   now = placement(time), before = placement(time - dt);
    if (!is_repeated)
    {
      reaction = 0;
      moment   = 0;
      work     = 0;
      accounts.begin_step();
      if (is_moved())
        look_around(now, grid.active_nodes, grid);
    }
    for (const Touched &one : touched)
    {
      double        *node = grid.fields[one.node];
      const double   m    = node[Fields::mass];
      Tensor<1, dim> v, v_body;
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = node[Fields::velocity + d];
      // At a wall a node without material of its own may stand for a ghost's.
      if (!(m > grid.mass_floor) && v.norm_square() == 0)
        continue;
      const Point<dim> x = grid.node_position(one.node);
      if (is_moved())
        v_body = (x - before.from(now.back(x))) / step;
      const Tensor<1, dim> dv = change(one, m, v, v_body, held, step, is_repeated);
      for (unsigned int d = 0; d < dim; ++d)
      {
        node[Fields::velocity + d] += dv[d];
        node[Fields::increment + d] += dv[d];
      }
      if (is_repeated)
        continue;
      Tensor<1, dim> impulse = -m * dv;
      if (walls != nullptr)
        for (unsigned int d = 0; d < dim; ++d)
          impulse[d] = -walls->carried_mass(one.node, m)[d] * dv[d];
      count(x - now.centre - now.displacement, impulse, v + dv, step);
    }
  }

  template <int dim>
  Tensor<1, dim> Obstacle<dim>::change(const Touched &touched, const double m, const Tensor<1, dim> &v,
                                       const Tensor<1, dim> &v_body, const HeldComponents<dim> &held, const double dt,
                                       const bool is_repeated)
  {
    // What is held stays: the obstacle acts on the other components.
    const auto free = [&](Tensor<1, dim> vector) {
      for (unsigned int d = 0; d < dim; ++d)
        if (held(touched.node, d))
          vector[d] = 0;
      return vector;
    };
    const Tensor<1, dim> n      = free(touched.normal);
    const double         square = n.norm_square();
    if (!(square > 1e-6))
      return {};
    const Tensor<1, dim> r        = v - v_body;
    const double         approach = std::max(-(r * touched.normal), 0.);
    const double         pressed  = approach / square; // along the normal as a whole, of which n is what is free
    Tensor<1, dim>       dv = pressed * n, slip = free(r + dv);
    slip -= (slip * n) / square * n;
    const double speed = slip.norm();

    // With an account friction may use what it has not used in earlier steps.
    typename FrictionAccounts<dim>::Account account{};
    const bool                              has_account = account_time > 0 && friction > 0 && m > 0;
    const double most = friction * (has_account ? usable(touched, m * pressed, dt, account) / m : pressed);
    if (has_account && !is_repeated)
    {
      account[0] = speed <= most ? account[0] - m * speed / friction : 0.;
      accounts.keep(touched.node, touched.number, account);
    }
    return speed > 0 ? dv - std::min(speed, most) / speed * slip : dv;
  }

  template <int dim>
  double Obstacle<dim>::usable(const Touched &touched, const double J, const double dt,
                               typename FrictionAccounts<dim>::Account &account) const
  {
    if (!(account_time > 0))
      return J;
    if (const auto *before = accounts.of(touched.node, touched.number))
      account = *before;
    const double share = std::min(1., dt / account_time);
    account[0]         = (1 - share) * account[0] + J;
    account[1] += share * (J - account[1]);
    return std::min(account[0], std::max(J, 10 * account[1]));
  }

  template <int dim>
  void Obstacle<dim>::count(const Tensor<1, dim> &arm, const Tensor<1, dim> &impulse, const Tensor<1, dim> &v,
                            const double dt)
  {
    reaction += impulse / dt;
    work -= impulse * v;
    if constexpr (dim == 2)
      moment[0] += (arm[0] * impulse[1] - arm[1] * impulse[0]) / dt;
    else
      moment += cross_product_3d(arm, impulse) / dt;
  }

  template <int dim>
  void Obstacle<dim>::serialize(Archive &archive, const Grid<dim> &grid)
  {
    if (account_time > 0)
      accounts.serialize(archive, grid, {&own_nodes});
  }

  template <int dim>
  void Obstacle<dim>::add_to(Table &table) const
  {
    table.add("reaction " + name, "force", reaction);
    if constexpr (dim == 2)
      table.add("moment " + name + " z", "force length", moment[0]);
    else
      table.add("moment " + name, "force length", moment);
  }

  template class Obstacle<2>;
  template class Obstacle<3>;
} // namespace Talus
