#include <talus/core/half_space.h>
#include <talus/simulation/checks.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;
  using internal::axes;
  using internal::sentence;

  namespace
  {
    /** The axes of the planes that a condition's lists of nodes belong to: of its boundary ids, then of half spaces. */
    std::vector<unsigned int> axes_of_lists(const Parameters &parameters, const std::string &section, const int dim)
    {
      std::vector<unsigned int> result;
      for (const auto &id : Utilities::split_string_list(parameters.value(section, "Boundary ids", "")))
        result.push_back(std::strtoul(id.c_str(), nullptr, 10) / 2);
      for (const auto &text : Utilities::split_string_list(parameters.value(section, "Half spaces", "")))
        if (const auto half_space = read_half_space(text, dim))
          result.push_back(half_space->axis);
      return result;
    }
  } // namespace

  template <int dim>
  void Checks<dim>::check_intervals()
  {
    for (const auto &condition : model.boundary.conditions)
    {
      if (condition->start() >= end_time)
        warn(condition->get_section_name(), "Start time",
             sentence("the condition never acts: it begins at ", condition->start(), " and the run ends at ", end_time,
                      "."));
      if (condition->end() <= 0)
        warn(condition->get_section_name(), "End time",
             sentence("the condition never acts: it ends at ", condition->end(), ", and the run begins at 0."));
    }
  }

  template <int dim>
  void Checks<dim>::check_edges()
  {
    const auto box = dynamic_cast<const BoxGrid<dim> *>(&model.grid);
    if (box == nullptr)
      return;                                      // a mesh has no lines of nodes
    constexpr double near = 0.1, tolerance = 1e-6; // [h]
    for (const auto &condition : model.boundary.conditions)
      for (const auto &edge : condition->edges())
      {
        const unsigned int d    = edge.axis;
        const auto         line = box->nearest_line(edge.position, d);
        // How far the line lies outside.
        const double beyond = !line ? 0 : edge.is_upper ? -line->second : line->second;
        if (beyond > tolerance && beyond < near)
          warn(condition->get_section_name(), edge.entry,
               sentence(axes[d], " = ", edge.position, " leaves out the nodes at ", axes[d], " = ", line->first, ", ",
                        beyond, " spacings away. Move it onto them if they are meant."));
      }
  }

  template <int dim>
  void Checks<dim>::check_overridden()
  {
    // Nodes that a condition holds wholly, whatever came before.
    const auto holds_all = [&](const Condition<dim> &condition) {
      const std::string type       = parameters.value(condition.get_section_name(), "Type", "no-slip");
      const std::string components = parameters.value(condition.get_section_name(), "Components", "x, y, z");
      return type == "no-slip" ||
             (type == "velocity" && std::count_if(components.begin(), components.end(), [](char c) {
                                      return c >= 'x' && c <= 'z';
                                    }) >= static_cast<int>(dim));
    };
    const auto nodes_of = [&](const Condition<dim> &condition) {
      std::vector<unsigned int> nodes;
      for (const auto &list : condition.owned_nodes())
        nodes.insert(nodes.end(), list.begin(), list.end());
      for (const auto &part : condition.owned_parts())
        nodes.insert(nodes.end(), part.nodes.begin(), part.nodes.end());
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    };
    const auto &conditions = model.boundary.conditions;
    for (unsigned int c = 0; c < conditions.size(); ++c)
      for (unsigned int other = c + 1; other < conditions.size(); ++other)
        if (holds_all(*conditions[other]) && conditions[other]->start() <= std::max(0., conditions[c]->start()) &&
            conditions[other]->end() >= std::min(end_time, conditions[c]->end()))
        {
          const auto nodes = nodes_of(*conditions[c]), others = nodes_of(*conditions[other]);
          const bool differs = !std::includes(others.begin(), others.end(), nodes.begin(), nodes.end());
          if (Utilities::MPI::logical_or(differs, model.grid.communicator))
            continue;
          warn(conditions[c]->get_section_name(), "Type",
               sentence("the condition has no effect: '", model.boundary.names[other],
                        "', which comes later in 'Names', has the last word at all its nodes."));
          break;
        }
  }

  template <int dim>
  Tensor<1, dim> Checks<dim>::mean_pull(const unsigned int body) const
  {
    const auto &acceleration = model.acceleration;
    const auto  size         = extents[body].upper - extents[body].lower;
    const auto  middle       = extents[body].lower + size / 2;
    // A formula that is never asked for some place or time need not be finite there.
    const auto value = [&](const Tensor<1, dim> &x, const double time) {
      try
      {
        return acceleration.value(Point<dim>(x), time);
      }
      catch (const EntryError &)
      {
        return Tensor<1, dim>();
      }
    };
    constexpr unsigned int n_times = 64;
    Tensor<1, dim>         mean;
    // On either side of the middle along each axis: forces that go round it, or towards it, are no pull.
    for (unsigned int k = 0; k < n_times; ++k)
      for (unsigned int d = 0; d < dim; ++d)
        for (const double side : {-0.25, 0.25})
        {
          Tensor<1, dim> x = middle;
          x[d] += side * size[d];
          mean += value(x, end_time * (k + 0.5) / n_times) / (2. * dim * n_times);
        }
    return mean;
  }

  template <int dim>
  bool Checks<dim>::is_held(const unsigned int body, const unsigned int axis, const bool is_upper) const
  {
    const Extent &extent = extents[body];
    const auto    holds  = [&](const unsigned int i) {
      const auto x        = model.grid.node_position(i);
      bool       is_below = true;
      for (unsigned int e = 0; e < dim; ++e)
        is_below = is_below && (x[e] > extent.lower[e] - 2 * model.grid.spacing[e] || (e == axis && !is_upper)) &&
                   (x[e] < extent.upper[e] + 2 * model.grid.spacing[e] || (e == axis && is_upper));
      return is_below;
    };
    bool is_held = false;
    for (const auto &condition : model.boundary.conditions)
    {
      const std::string section    = condition->get_section_name();
      const std::string type       = parameters.value(section, "Type", "no-slip");
      const std::string components = parameters.value(section, "Components", "xyz");
      if (type == "velocity" && components.find(axes[axis]) == std::string::npos)
        continue;
      const bool  holds_normal = type != "velocity" && type != "no-slip";
      const auto  of_lists     = axes_of_lists(parameters, section, dim);
      const auto &lists        = condition->owned_nodes();
      for (unsigned int list = 0; list < lists.size(); ++list)
        if (!holds_normal || (list < of_lists.size() && of_lists[list] == axis))
          is_held = is_held || std::any_of(lists[list].begin(), lists[list].end(), holds);
      for (const auto &part : condition->owned_parts())
        for (unsigned int k = 0; k < part.nodes.size(); ++k)
          is_held = is_held || (holds(part.nodes[k]) &&
                                (!holds_normal || std::any_of(part.normals[k].begin(), part.normals[k].end(),
                                                              [&](const auto &n) { return std::abs(n[axis]) > 0.1; })));
    }
    return Utilities::MPI::logical_or(is_held, model.grid.communicator);
  }

  template <int dim>
  void Checks<dim>::check_floor()
  {
    if (!model.contacts.all.empty() || !model.boundary.obstacles.empty())
      return;
    const bool is_box = dynamic_cast<const BoxGrid<dim> *>(&model.grid) != nullptr;
    for (unsigned int body = 0; body < extents.size(); ++body)
    {
      // Along the axis of the strongest pull alone: a slope turns gravity.
      const Tensor<1, dim> b = mean_pull(body);
      unsigned int         d = 0;
      for (unsigned int e = 1; e < dim; ++e)
        if (std::abs(b[e]) >= std::abs(b[d]))
          d = e;
      const bool   is_upper = b[d] > 0;
      const double distance =
        is_upper ? model.grid.upper[d] - extents[body].upper[d] : extents[body].lower[d] - model.grid.lower[d];
      // It does not come there in time, or round-off alone is left of a shaking.
      if (0.5 * std::abs(b[d]) * end_time * end_time < std::max(distance, 1e-9 * model.grid.spacing[d]))
        continue;
      if (is_held(body, d, is_upper))
        continue;
      warn("/Conditions", "Names",
           sentence("the body '", model.bodies[body]->name, "' falls along ", axes[d],
                    ", and nothing holds it: ", is_box ? "the face " : "the boundary at ", axes[d],
                    is_upper ? "+" : "-", " of the grid has no condition. Give one with '",
                    is_box ? "Boundary ids = " + std::to_string(2 * d + is_upper) : std::string("Boundaries"), "'."));
      return;
    }
  }

  template <int dim>
  void Checks<dim>::check_idle_entries()
  {
    const auto number = [&](const std::string &section, const std::string &entry) {
      return std::strtod(parameters.value(section, entry, "0").c_str(), nullptr);
    };
    // Warns of an entry that is set beside another that makes it idle.
    const auto idle = [&](const std::string &section, const std::string &entry, const bool is_idle,
                          const std::string &reason) {
      if (is_idle && parameters.is_set(section, entry))
        warn(section, entry, "it has no effect: " + reason);
    };
    idle("/Run", "Courant number", number("/Run", "Step size") > 0, "'Step size' says how long steps are.");
    if (model.walls.has_ghosts() && parameters.value("/Transfer", "Slip projection", "false") == "true")
      throw EntryError(
        "/Transfer", "Slip projection",
        "it acts on kernels that a wall cuts off, and with 'Boundary treatment = ghost nodes' none is. Leave it "
        "out: ghost nodes make floors quiet themselves.");
    const std::string transfer = parameters.value("/Transfer", "Type", "TPIC");
    for (const auto &body : model.bodies)
    {
      const std::string section = body->get_section_name();
      idle(section, "Seed", number(section, "Jitter") == 0, "'Jitter' is 0.");
      idle(section, "Velocity gradient", transfer == "FLIP" || transfer == "PIC",
           "the transfer " + transfer + " has no gradients of particles.");
    }
    for (const auto &condition : model.boundary.conditions)
    {
      const std::string section = condition->get_section_name();
      idle(section, "Wall velocity", number(section, "Friction coefficient") == 0,
           "a wall moves along itself, and without a 'Friction coefficient' nothing follows it.");
      if (number(section, "Account time") > 0 && !model.walls.has_ghosts())
        throw EntryError(
          section, "Account time",
          "accounts are kept where walls have ghost nodes. Set 'Boundary treatment = ghost nodes', or 0.");
    }
  }

  template <int dim>
  void Checks<dim>::check_steps(const double step_size, const double signal_speed, const unsigned int max_steps)
  {
    const double      h        = model.grid.smallest_spacing;
    const bool        is_fixed = std::strtod(parameters.value("/Run", "Step size", "0").c_str(), nullptr) > 0;
    const std::string entry    = is_fixed ? "Step size" : "Courant number";
    const double      n_steps  = end_time / step_size;
    if (!(n_steps < 1 / std::numeric_limits<double>::epsilon()))
      throw EntryError("/Run", entry,
                       sentence("steps of ", step_size, " are lost in the round-off of the end time ", end_time,
                                ": the run would never end. Take larger ones, or an earlier 'End time'."));
    if (n_steps > std::numeric_limits<unsigned int>::max() && max_steps == 0)
      throw EntryError("/Run", "End time",
                       sentence("the run would take ", n_steps, " steps of ", step_size, " to the end time ", end_time,
                                ", more than can be counted. Check the units of times and stiffnesses."));
    if (n_steps > 1e9 && max_steps == 0)
      warn("/Run", "End time",
           sentence("the run takes ", n_steps, " steps of ", step_size, " to the end time ", end_time,
                    ". Check the units of times and stiffnesses."));
    const double b = model.acceleration.value(model.grid.lower + (model.grid.upper - model.grid.lower) / 2, 0.).norm();
    if (0.5 * b * step_size * step_size > h)
      warn("/Run", entry,
           sentence("in one step of ", step_size, " a particle falls over more than a cell: ",
                    0.5 * b * step_size * step_size / h, " spacings. Take smaller steps, or check the stiffness."));
    if (is_fixed && step_size * signal_speed > h * (1 + 1e-9))
      warn("/Run", "Step size",
           sentence("it is ", step_size, ", but a signal crosses a cell in ", h / signal_speed,
                    ": steps as long as that are unstable. Take ", 0.4 * h / signal_speed, "."));
    for (const auto &condition : model.boundary.conditions)
      if (condition->end() - condition->start() < step_size)
        warn(condition->get_section_name(), "End time",
             sentence("the condition acts from ", condition->start(), " to ", condition->end(),
                      ", which is less than a step of ", step_size, ": in one step, or in none."));
  }

#define INSTANTIATE(dim)                                                                                               \
  template void           Checks<dim>::check_intervals();                                                              \
  template void           Checks<dim>::check_edges();                                                                  \
  template void           Checks<dim>::check_overridden();                                                             \
  template Tensor<1, dim> Checks<dim>::mean_pull(const unsigned int) const;                                            \
  template bool           Checks<dim>::is_held(const unsigned int, const unsigned int, const bool) const;              \
  template void           Checks<dim>::check_floor();                                                                  \
  template void           Checks<dim>::check_idle_entries();                                                           \
  template void           Checks<dim>::check_steps(const double, const double, const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus
