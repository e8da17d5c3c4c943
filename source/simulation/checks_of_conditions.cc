#include <talus/simulation/checks.h>

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
  void Checks<dim>::check_floor()
  {
    const bool           is_box = dynamic_cast<const BoxGrid<dim> *>(&model.grid) != nullptr;
    const Tensor<1, dim> b = model.acceleration.value(model.grid.lower + (model.grid.upper - model.grid.lower) / 2, 0.);
    for (unsigned int d = 0; d < dim; ++d)
    {
      // Along the axis of the strongest pull alone: a slope turns gravity.
      bool is_strongest = b[d] != 0;
      for (unsigned int e = 0; e < dim; ++e)
        is_strongest = is_strongest && std::abs(b[e]) <= std::abs(b[d]);
      if (!is_strongest)
        continue;
      const bool is_upper = b[d] > 0;
      for (unsigned int body = 0; body < extents.size(); ++body)
      {
        const Extent &extent = extents[body];
        const double  distance =
          is_upper ? model.grid.upper[d] - extent.upper[d] : extent.lower[d] - model.grid.lower[d];
        if (distance > 0.5 * std::abs(b[d]) * end_time * end_time)
          continue; // it does not come there in time
        // Something below it, or within the body, or nearly so, that holds it.
        const auto holds = [&](const std::vector<unsigned int> &nodes) {
          return std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int i) {
            const auto x        = model.grid.node_position(i);
            bool       is_below = true;
            for (unsigned int e = 0; e < dim; ++e)
              is_below = is_below && (x[e] > extent.lower[e] - 2 * model.grid.spacing[e] || (e == d && !is_upper)) &&
                         (x[e] < extent.upper[e] + 2 * model.grid.spacing[e] || (e == d && is_upper));
            return is_below;
          });
        };
        bool is_held = !model.contacts.all.empty();
        for (const auto &condition : model.boundary.conditions)
        {
          for (const auto &nodes : condition->owned_nodes())
            is_held = is_held || holds(nodes);
          for (const auto &part : condition->owned_parts())
            is_held = is_held || holds(part.nodes);
        }
        if (Utilities::MPI::max(is_held ? 1 : 0, model.grid.communicator) == 0)
        {
          warn("/Conditions", "Names",
               sentence("the body '", model.bodies[body]->name, "' falls along ", axes[d],
                        ", and nothing holds it: ", is_box ? "the face " : "the boundary at ", axes[d],
                        is_upper ? "+" : "-", " of the grid has no condition. Give one with '",
                        is_box ? "Boundary ids = " + std::to_string(2 * d + is_upper) : std::string("Boundaries"),
                        "'."));
          break;
        }
      }
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
  }

#define INSTANTIATE(dim)                                                                                               \
  template void Checks<dim>::check_intervals();                                                                        \
  template void Checks<dim>::check_edges();                                                                            \
  template void Checks<dim>::check_floor();                                                                            \
  template void Checks<dim>::check_idle_entries();                                                                     \
  template void Checks<dim>::check_steps(const double, const double, const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus
