#include <talus/boundary/boundary.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Boundary<dim>::mark_slip_walls(const double time, const unsigned int n, Grid<dim> &grid)
  {
    std::vector<bool> acting;
    for (const auto &condition : conditions)
      acting.push_back(condition->acts(time));
    if (acting == marked)
      return;
    marked         = acting;
    const auto box = dynamic_cast<BoxGrid<dim> *>(&grid);
    if (box == nullptr)
      return; // meshes have no treatment that would ask
    // Where something else acts as well a wall does not slip, whatever the order of the list.
    std::vector<BoxFaces> faces(grid.fields.n_owned(), 0);
    for (const bool is_slip : {true, false})
      for (unsigned int c = 0; c < conditions.size(); ++c)
        if (acting[c] && conditions[c]->is_slip() == is_slip)
          conditions[c]->mark_slip(faces);
    box->set_slip_walls(faces, n);
  }

  template <int dim>
  void Boundary<dim>::solve(const double time, const double dt, Walls<dim> &walls, Grid<dim> &grid)
  {
    prescribed.clear(grid.fields.n_owned());
    for (prescribed.condition = 0; prescribed.condition < conditions.size(); ++prescribed.condition)
      conditions[prescribed.condition]->prescribe(time, grid, prescribed);
    walls.solve(prescribed, dt, damping.factor);
    account(dt, grid);
    held.clear(grid.fields.n_owned());
    damping.apply(walls.plain_nodes, held, grid);
    damping.work += walls.damping_work;
    if (dt > 0)
      meet_obstacles(time, dt, &walls, grid);
  }

  template <int dim>
  void Boundary<dim>::meet_obstacles(const double time, const double dt, Walls<dim> *walls, Grid<dim> &grid,
                                     const bool is_repeated)
  {
    if (obstacles.empty())
      return;
    if (walls != nullptr)
    {
      walls->carry_masses();
      for (const auto &node : prescribed.nodes)
        for (unsigned int c = 0; c < dim; ++c)
          if (node.holder[c] != Prescribed<dim>::nobody)
            held.hold(node.node, c);
    }
    for (auto &obstacle : obstacles)
      obstacle->apply(time, dt, held, walls, grid, is_repeated);
  }

  template <int dim>
  void Boundary<dim>::repeat(const double time, const double dt, Walls<dim> &walls, Grid<dim> &grid)
  {
    struct Sums
    {
      Tensor<1, dim> reaction, nodal_force;
      double         work;
    };
    std::vector<Sums> sums;
    for (const auto &condition : conditions)
      sums.push_back({condition->reaction, condition->nodal_force, condition->work});
    const auto mirrored_force = grid.fields.mirrored_force;
    const auto before         = damping;
    damping.factor            = 0;
    if (walls.has_ghosts())
      solve(time, /* dt = */ 0., walls, grid);
    else
    {
      held.clear(grid.fields.n_owned());
      for (auto &condition : conditions)
        condition->apply(time, dt, grid, held);
    }
    meet_obstacles(time, dt, walls.has_ghosts() ? &walls : nullptr, grid, /* is_repeated = */ true);
    damping                    = before;
    grid.fields.mirrored_force = mirrored_force;
    for (unsigned int c = 0; c < conditions.size(); ++c)
    {
      conditions[c]->reaction    = sums[c].reaction;
      conditions[c]->nodal_force = sums[c].nodal_force;
      conditions[c]->work        = sums[c].work;
    }
  }

  template <int dim>
  void Boundary<dim>::account(const double dt, const Grid<dim> &grid)
  {
    const double step = dt > 0 ? dt : 1.;
    for (const auto &node : prescribed.nodes)
      for (unsigned int c = 0; c < dim; ++c)
      {
        if (const auto &contact = node.contact[c]; dt > 0 && contact.account_time > 0)
          conditions[contact.condition]->keep(node.node, c, contact);
        const double v = grid.fields[node.node][NodalFields<dim>::velocity + c];
        if (node.holder[c] != Prescribed<dim>::nobody)
          conditions[node.holder[c]]->take(c, node.impulse[c], node.force_impulse[c], v, step);
        bool is_counted = node.holder[c] != Prescribed<dim>::nobody;
        for (const auto &contact : node.contact)
          if (contact.acts)
          {
            conditions[contact.condition]->take(c, contact.impulse[c], is_counted ? 0. : node.force_impulse[c], v,
                                                step);
            is_counted = true;
          }
      }
  }

  template <int dim>
  void Boundary<dim>::add_to(Table &table) const
  {
    for (unsigned int c = 0; c < conditions.size(); ++c)
      table.add("reaction " + names[c], "force", conditions[c]->reaction);
    for (unsigned int c = 0; c < conditions.size(); ++c)
      table.add("nodal force " + names[c], "force", conditions[c]->nodal_force);
    for (const auto &obstacle : obstacles)
      obstacle->add_to(table);
  }

  template class Boundary<2>;
  template class Boundary<3>;
} // namespace Talus
