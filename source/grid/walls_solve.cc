#include <talus/grid/walls.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Walls<dim>::solve(Prescribed<dim> &prescribed, const double dt, const double damping)
  {
    read(prescribed);
    grid->update_velocity(dt, plain_nodes);

    find_presses();
    for (unsigned int c = 0; c < dim; ++c)
    {
      Unknowns &of = unknowns[c];
      of.is_fixed.assign(real_node.size(), false);
      of.load.assign(real_node.size(), 0.);
      solve_component(c, dt, of.v);
    }
    for (Press &one : presses)
      press(one, dt);

    damping_work           = 0;
    const bool has_mirrors = std::find(is_mirrored.begin(), is_mirrored.end(), true) != is_mirrored.end();
    for (unsigned int c = 0; c < dim; ++c)
    {
      if (damping > 0 || has_mirrors)
        solve_component(c, 0., unknowns[c].before);
      if (damping > 0)
        damp(c, damping);
      find_rest(c, dt);
      write(c);
    }
    account(prescribed);
  }

  template <int dim>
  void Walls<dim>::assemble(const unsigned int c, const double dt)
  {
    const Rows &row = rows[c];
    Unknowns   &of  = unknowns[c];
    of.right.resize(real_node.size());
    of.diagonal.resize(real_node.size());
    for (unsigned int r = 0; r < real_node.size(); ++r)
    {
      of.diagonal[r] = mass(r);
      of.right[r]    = impulse(r, c, dt);
    }
    for (const unsigned int g : ghost_order)
    {
      const double m = mass(ghost(g));
      double       Q = impulse(ghost(g), c, dt);
      for (unsigned int e = row.begin[g]; e < row.begin[g + 1]; ++e)
        if (const Entry &entry = row.entries[e]; asks(entry.real, held, c))
          Q -= m * entry.coefficient * record(entry.real, held_velocity + c);
      for (unsigned int e = row.begin[g]; e < row.begin[g + 1]; ++e)
      {
        const Entry &entry = row.entries[e];
        of.diagonal[entry.real] += entry.coefficient * entry.coefficient * m;
        of.right[entry.real] += entry.coefficient * Q;
      }
    }
  }

  template <int dim>
  void Walls<dim>::solve_component(const unsigned int c, const double dt, std::vector<double> &v)
  {
    assemble(c, dt);
    Unknowns &of = unknowns[c];
    v.resize(real_node.size());
    of.is_left_out.assign(real_node.size(), false);
    for (unsigned int r = 0; r < real_node.size(); ++r)
      if (asks(r, held, c))
        v[r] = record(r, held_velocity + c);
      else if (rows[c].block[r] == none)
      {
        // Empty nodes keep v = 0: dividing by m_i = 0 would spread NaN.
        of.is_left_out[r] = !(of.diagonal[r] > grid->mass_floor);
        v[r]              = of.is_left_out[r] ? 0. : of.right[r] / of.diagonal[r];
      }
    for (unsigned int block = 0; block < rows[c].blocks.size(); ++block)
      solve_block(c, block, v);
  }

  template <int dim>
  void Walls<dim>::assemble_block(const unsigned int c, const Block &block)
  {
    const Rows     &row = rows[c];
    const Unknowns &of  = unknowns[c];
    factor.reinit(block.reals.size());
    for (unsigned int i = 0; i < block.reals.size(); ++i)
    {
      const unsigned int r = block.reals[i];
      factor(i, i)         = of.diagonal[r];
      factor.b(i)          = of.right[r] - of.load[r];
    }
    for (const unsigned int g : block.ghosts)
      for (unsigned int e = row.begin[g]; e < row.begin[g + 1]; ++e)
      {
        const unsigned int i = row.local[row.entries[e].real];
        if (i == none)
          continue; // held
        for (unsigned int f = row.begin[g]; f < row.begin[g + 1]; ++f)
          if (const unsigned int j = row.local[row.entries[f].real]; j != none && j != i)
            factor(i, j) += row.entries[e].coefficient * row.entries[f].coefficient * mass(ghost(g));
      }
  }

  template <int dim>
  void Walls<dim>::solve_block(const unsigned int c, const unsigned int number, std::vector<double> &v)
  {
    const Block &block = rows[c].blocks[number];
    Unknowns    &of    = unknowns[c];
    assemble_block(c, block);
    for (unsigned int i = 0; i < block.reals.size(); ++i)
      if (of.is_fixed[block.reals[i]])
        factor.fix(i, of.v[block.reals[i]]);
    factor.solve(grid->mass_floor);
    for (unsigned int i = 0; i < block.reals.size(); ++i)
    {
      v[block.reals[i]]              = factor.value(i);
      of.is_left_out[block.reals[i]] = factor.is_left_out(i);
    }
  }

  template <int dim>
  void Walls<dim>::damp(const unsigned int c, const double alpha)
  {
    Unknowns           &of = unknowns[c];
    std::vector<double> change(real_node.size(), 0.);
    for (unsigned int r = 0; r < real_node.size(); ++r)
      if (!asks(r, held, c) && !of.is_fixed[r] && of.load[r] == 0 && of.before[r] != 0)
        change[r] = -alpha * std::copysign(of.v[r] - of.before[r], of.before[r]);
    for (unsigned int r = 0; r < real_node.size(); ++r)
      of.v[r] += change[r];
    for (unsigned int r = 0; r < n_owned_reals; ++r)
      if (rows[c].block[r] == none)
        damping_work += of.diagonal[r] * change[r] * of.v[r];
    for (const Block &block : rows[c].blocks)
    {
      assemble_block(c, block);
      for (unsigned int i = 0; i < block.reals.size(); ++i)
        for (unsigned int j = 0; block.reals[i] < n_owned_reals && j < block.reals.size(); ++j)
          damping_work += factor(i, j) * change[block.reals[j]] * of.v[block.reals[i]];
    }
  }

  template <int dim>
  void Walls<dim>::find_rest(const unsigned int c, const double dt)
  {
    const Rows &row = rows[c];
    Unknowns   &of  = unknowns[c];
    of.rest.resize(real_node.size());
    of.force.resize(real_node.size());
    for (unsigned int r = 0; r < real_node.size(); ++r)
    {
      of.rest[r]  = impulse(r, c, dt) - mass(r) * of.v[r];
      of.force[r] = dt * record(r, NodalFields<dim>::force + c);
    }
    for (unsigned int g = 0; g < ghost_place.size(); ++g)
    {
      double v = 0;
      for (unsigned int e = row.begin[g]; e < row.begin[g + 1]; ++e)
        v += row.entries[e].coefficient * of.v[row.entries[e].real];
      const double rest = impulse(ghost(g), c, dt) - mass(ghost(g)) * v;
      const double f    = dt * record(ghost(g), NodalFields<dim>::force + c);
      for (unsigned int e = row.begin[g]; e < row.begin[g + 1]; ++e)
      {
        of.rest[row.entries[e].real] += row.entries[e].coefficient * rest;
        of.force[row.entries[e].real] += row.entries[e].coefficient * f;
      }
    }
  }

  template <int dim>
  void Walls<dim>::write(const unsigned int c)
  {
    using Fields       = NodalFields<dim>;
    const Unknowns &of = unknowns[c];
    for (unsigned int r = 0; r < n_owned_reals; ++r)
    {
      double      *to          = grid->fields[real_node[r]];
      const double m           = mass(r);
      to[Fields::velocity + c] = of.v[r];
      // FLIP's increment: from what the particles brought to this node, not from what is folded onto it.
      if (asks(r, symmetric, c))
        to[Fields::increment + c] = 0;
      else if (is_mirrored[r])
        to[Fields::increment + c] = of.v[r] - of.before[r];
      else
        to[Fields::increment + c] = m > 0 ? of.v[r] - impulse(r, c, 0.) / m : 0.;
      if (of.is_left_out[r])
        grid->lost_momentum[c] += of.rest[r];
    }
  }

  template <int dim>
  void Walls<dim>::account(Prescribed<dim> &prescribed) const
  {
    for (auto &node : prescribed.nodes)
    {
      const unsigned int r = position[node.node];
      for (unsigned int c = 0; c < dim; ++c)
      {
        node.force_impulse[c] = unknowns[c].force[r];
        node.impulse[c]       = asks(r, symmetric, c) ? unknowns[c].force[r] : unknowns[c].rest[r];
      }
    }
    for (const Press &press : presses)
    {
      if (press.real >= n_owned_reals)
        continue;
      auto &contact   = prescribed.of(real_node[press.real]).contact[press.axis];
      contact.account = press.account;
      contact.mean    = press.mean;
      if (!press.acts)
        continue;
      contact.acts    = true;
      contact.impulse = press.load;
      for (unsigned int c = 0; c < dim; ++c)
        if (press.fixes[c])
          contact.impulse[c] += unknowns[c].rest[press.real] - unknowns[c].load[press.real];
    }
  }

  template <int dim>
  void Walls<dim>::carry_masses()
  {
    carried.resize(real_node.size());
    for (unsigned int c = 0; c < dim; ++c)
    {
      for (unsigned int r = 0; r < real_node.size(); ++r)
        carried[r][c] = mass(r);
      for (const unsigned int g : ghost_order)
        for (unsigned int e = rows[c].begin[g]; e < rows[c].begin[g + 1]; ++e)
          carried[rows[c].entries[e].real][c] += rows[c].entries[e].coefficient * mass(ghost(g));
    }
  }

  template <int dim>
  Tensor<1, dim> Walls<dim>::carried_mass(const unsigned int node, const double mass) const
  {
    if (has_ghosts() && position[node] != none)
      return carried[position[node]];
    Tensor<1, dim> result;
    for (unsigned int c = 0; c < dim; ++c)
      result[c] = mass;
    return result;
  }

#define INSTANTIATE(dim)                                                                                               \
  template void           Walls<dim>::solve(Prescribed<dim> &, const double, const double);                            \
  template void           Walls<dim>::assemble(const unsigned int, const double);                                      \
  template void           Walls<dim>::solve_component(const unsigned int, const double, std::vector<double> &);        \
  template void           Walls<dim>::assemble_block(const unsigned int, const Block &);                               \
  template void           Walls<dim>::solve_block(const unsigned int, const unsigned int, std::vector<double> &);      \
  template void           Walls<dim>::damp(const unsigned int, const double);                                          \
  template void           Walls<dim>::find_rest(const unsigned int, const double);                                     \
  template void           Walls<dim>::write(const unsigned int);                                                       \
  template void           Walls<dim>::account(Prescribed<dim> &) const;                                                \
  template void           Walls<dim>::carry_masses();                                                                  \
  template Tensor<1, dim> Walls<dim>::carried_mass(const unsigned int, const double) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus
