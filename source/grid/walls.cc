#include <talus/grid/wall_rows.h>
#include <talus/grid/walls.h>

#include <algorithm>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Calls `body(ghost)` for the ghosts next to a node of the domain: beyond each choice of the faces it lies on. */
    template <std::size_t dim, class Body>
    void for_each_ghost(const std::array<int, dim> &node, const std::array<int, dim> &n_cells, const Body &body)
    {
      unsigned int faces = 0;
      for (unsigned int d = 0; d < dim; ++d)
        faces |= (node[d] == 0 || node[d] == n_cells[d]) << d;
      for (unsigned int axes = 1; axes < 1u << dim; ++axes)
      {
        if ((axes & ~faces) != 0)
          continue;
        auto index = node;
        for (unsigned int d = 0; d < dim; ++d)
          if (axes >> d & 1)
            index[d] += node[d] == 0 ? -1 : 1;
        body(index);
      }
    }

    constexpr auto holds_nothing = [](const auto &, const unsigned int) { return false; };
  } // namespace

  template <int dim>
  void Walls<dim>::attach(BoxGrid<dim> &grid)
  {
    this->grid = &grid;
    ghost_place.clear();
    select();
  }

  template <int dim>
  bool Walls<dim>::is_near_face(const Index &index) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (index[d] <= 1 || index[d] >= grid->lattice.n_cells[d] - 1)
        return true;
    return false;
  }

  template <int dim>
  void Walls<dim>::select()
  {
    if (!has_ghosts())
      return;
    for (const unsigned int place : ghost_place)
      std::fill_n(grid->fields.at_place(place), 8, 0.); // who is no longer active is not cleared
    is_asked.assign(grid->fields.n_local(), false);
    number_nodes();
  }

  template <int dim>
  void Walls<dim>::serialize(Archive &archive)
  {
    if (!has_ghosts())
      return;
    const Archive::Scope scope(archive, "walls");
    std::vector<double>  asked_nodes;
    for (unsigned int i = 0; i < is_asked.size(); ++i)
      if (is_asked[i])
        asked_nodes.push_back(i);
    archive.of_rank("asked nodes", asked_nodes);
    if (!archive.is_reading())
      return;
    select();
    if (!archive.is_exact())
      return;
    for (const double i : asked_nodes)
      is_asked.at(static_cast<unsigned int>(i)) = true;
    number_nodes();
  }

  template <int dim>
  void Walls<dim>::number_nodes()
  {
    real_node.clear();
    plain_nodes.clear();
    position.assign(grid->fields.n_local(), none);
    n_owned_reals = 0;
    for (unsigned int i = 0; i < grid->fields.n_local(); ++i)
    {
      if (!grid->is_active[i])
        continue;
      if (is_near_face(grid->node_index[i]) || is_asked[i])
      {
        position[i] = real_node.size();
        real_node.push_back(i);
        n_owned_reals += i < grid->fields.n_owned();
      }
      else if (i < grid->fields.n_owned())
        plain_nodes.push_back(i);
    }
    number_ghosts();
    share_lists();
    records.assign(std::size_t{n_lanes} * wall_nodes.n_places(), 0.);
    state.assign(real_node.size(), 0);
    find_rows();
  }

  template <int dim>
  void Walls<dim>::number_ghosts()
  {
    const auto &lattice = grid->lattice;
    ghost_place.clear();
    ghost_wall.clear();
    ghost_index.clear();
    first_ghost.clear();
    for (unsigned int r = 0; r < real_node.size(); ++r)
    {
      first_ghost.push_back(ghost_place.size());
      if (r == n_owned_reals)
        n_owned_ghosts = ghost_place.size();
      for_each_ghost(grid->node_index[real_node[r]], lattice.n_cells, [&](const Index &index) {
        // A stencil that reaches a ghost has all nodes of its row: where one is not active, none comes.
        const auto row = wall_row<dim>(index, 0, lattice.n_cells, holds_nothing);
        for (unsigned int k = 0; k < row.size; ++k)
        {
          const unsigned int node = lattice.node_at(row.node[k]);
          if (node == lattice.missing || !grid->is_active[node])
            return;
        }
        ghost_place.push_back(lattice.table_index(index));
        ghost_wall.push_back(r);
        ghost_index.push_back(index);
      });
    }
    first_ghost.push_back(ghost_place.size());
    if (n_owned_reals == real_node.size())
      n_owned_ghosts = ghost_place.size();

    // Places in the tables of a lattice are in the same order on all ranks.
    const auto sort = [](std::vector<unsigned int> &order, const std::size_t n, const auto &place) {
      order.resize(n);
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return place(a) < place(b); });
    };
    sort(real_order, real_node.size(), [&](const unsigned int r) { return grid->nodes.place(real_node[r]); });
    sort(ghost_order, ghost_place.size(), [&](const unsigned int g) { return ghost_place[g]; });
  }

  template <int dim>
  void Walls<dim>::share_lists()
  {
    // Ghosts go with the real node next to them, so that the lists of the grid's nodes say all.
    const auto lists = [&](const std::vector<Nodes::Neighbour> &neighbours, const bool has_reals) {
      std::vector<Nodes::Neighbour> result;
      for (const auto &neighbour : neighbours)
      {
        Nodes::Neighbour list{neighbour.rank, {}};
        for (const unsigned int i : neighbour.nodes)
        {
          const unsigned int r = position[i];
          if (r == none || !is_near_face(grid->node_index[i]))
            continue;
          if (has_reals)
            list.nodes.push_back(r);
          for (unsigned int g = first_ghost[r]; g < first_ghost[r + 1]; ++g)
            list.nodes.push_back(has_reals ? ghost(g) : g);
        }
        if (!list.nodes.empty())
          result.push_back(list);
      }
      return result;
    };
    const auto &nodes = grid->nodes;
    ghost_nodes.reinit(n_owned_ghosts, ghost_place, nodes.n_places(), lists(nodes.copied_by, false),
                       lists(nodes.copied_from, false), nodes.communicator);
    std::vector<unsigned int> places(real_node.size() + ghost_place.size());
    for (unsigned int i = 0; i < places.size(); ++i)
      places[i] = i;
    wall_nodes.reinit(places.size(), places, places.size(), lists(nodes.copied_by, true),
                      lists(nodes.copied_from, true), nodes.communicator);
    ghost_exchange.reinit(ghost_nodes);
    exchange.reinit(wall_nodes);
  }

  template <int dim>
  void Walls<dim>::clear()
  {
    for (const unsigned int place : ghost_place)
      std::fill_n(grid->fields.at_place(place), 8, 0.);
  }

  template <int dim>
  void Walls<dim>::collect()
  {
    if (has_ghosts())
      ghost_exchange.add_to_owners(ghost_nodes, grid->fields.at_place(0));
  }

  template <int dim>
  void Walls<dim>::read(const Prescribed<dim> &prescribed)
  {
    bool is_new = false;
    for (const auto &node : prescribed.nodes)
      if (position[node.node] == none)
        is_asked[node.node] = is_new = true;
    if (is_new)
      number_nodes();

    for (unsigned int r = 0; r < n_owned_reals; ++r)
    {
      double *to = &records[std::size_t{n_lanes} * r];
      std::copy_n(grid->fields[real_node[r]], 8, to);
      std::fill(to + 8, to + n_lanes, 0.);
    }
    for (unsigned int g = 0; g < n_owned_ghosts; ++g)
      std::copy_n(grid->fields.at_place(ghost_place[g]), 8, &records[std::size_t{n_lanes} * ghost(g)]);
    enter(prescribed);
    exchange.update_copies(wall_nodes, records.data());

    bool has_changed = false;
    for (unsigned int r = 0; r < real_node.size(); ++r)
    {
      const auto now = static_cast<unsigned int>(record(r, asked));
      has_changed    = has_changed || now != state[r];
      state[r]       = now;
    }
    if (has_changed)
      find_rows();
  }

  template <int dim>
  void Walls<dim>::enter(const Prescribed<dim> &prescribed)
  {
    for (const auto &node : prescribed.nodes)
    {
      double      *to   = &records[std::size_t{n_lanes} * position[node.node]];
      unsigned int bits = 0;
      for (unsigned int c = 0; c < dim; ++c)
      {
        if (node.holder[c] != Prescribed<dim>::nobody)
        {
          bits |= 1u << (held + c);
          bits |= (node.is_symmetric[c] ? 1u : 0u) << (symmetric + c);
          to[held_velocity + c] = node.velocity[c];
        }
        const auto &contact = node.contact[c];
        if (contact.outward == 0)
          continue;
        bits |= 1u << ((contact.outward < 0 ? pressed_below : pressed_above) + c);
        to[friction + c]       = contact.coefficient;
        to[account_time + c]   = contact.account_time;
        to[account_before + c] = contact.account;
        to[mean_before + c]    = contact.mean;
        for (unsigned int d = 0; d < dim; ++d)
          to[wall_velocity + dim * c + d] = contact.velocity[d];
      }
      to[asked] = bits;
    }
  }

  template <int dim>
  void Walls<dim>::fill()
  {
    using Fields = NodalFields<dim>;
    for (unsigned int g = 0; g < ghost_place.size(); ++g)
    {
      double      *to = grid->fields.at_place(ghost_place[g]);
      const double m  = mass(ghost(g));
      for (unsigned int c = 0; c < dim; ++c)
      {
        double v = 0, increment = 0;
        for (unsigned int e = rows[c].begin[g]; e < rows[c].begin[g + 1]; ++e)
        {
          const auto   &entry = rows[c].entries[e];
          const double *from  = grid->fields[real_node[entry.real]];
          v += entry.coefficient * from[Fields::velocity + c];
          increment += entry.coefficient * from[Fields::increment + c];
        }
        to[Fields::velocity + c]  = v;
        to[Fields::increment + c] = is_mirrored_ghost[g] ? increment : m > 0 ? v - impulse(ghost(g), c, 0.) / m : 0.;
      }
    }
  }

  template class Walls<2>;
  template class Walls<3>;
} // namespace Talus
