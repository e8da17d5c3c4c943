#include <talus/steppers/remedy.h>

#include <algorithm>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** What the file, or the default, says of an entry. */
    std::string chosen(const std::string &section, const std::string &entry)
    {
      auto &prm = ParameterAcceptor::prm;
      prm.enter_subsection(section);
      const std::string value = prm.get(entry);
      prm.leave_subsection();
      return value;
    }

    std::string smaller_steps()
    {
      return std::strtod(chosen("Run", "Step size").c_str(), nullptr) > 0 ?
               "a smaller 'Step size', or 0 for steps by the Courant number" :
               "";
    }

    /** Marks of this rank's own nodes that conditions act on. */
    template <int dim>
    std::vector<bool> held_nodes(const Model<dim> &model)
    {
      std::vector<bool> is_held(model.grid.fields.n_owned(), false);
      const auto        mark = [&](const std::vector<unsigned int> &nodes) {
        for (const unsigned int i : nodes)
          is_held[i] = true;
      };
      for (const auto &condition : model.boundary.conditions)
      {
        for (const auto &list : condition->owned_nodes())
          mark(list);
        for (const auto &part : condition->owned_parts())
          mark(part.nodes);
      }
      return is_held;
    }

    /** The same for a mesh, by the node nearest to the particle. Collective. */
    template <int dim>
    std::string remedy_of_exit_from_mesh(const Model<dim> &model, const Point<dim> &x)
    {
      const std::vector<bool> is_held = held_nodes(model);
      double                  nearest = std::numeric_limits<double>::max(), nearest_held = nearest;
      for (unsigned int i = 0; i < is_held.size(); ++i)
      {
        const double distance = x.distance(model.grid.node_position(i));
        nearest               = std::min(nearest, distance);
        if (is_held[i])
          nearest_held = std::min(nearest_held, distance);
      }
      if (Utilities::MPI::min(nearest_held, model.grid.communicator) >
          Utilities::MPI::min(nearest, model.grid.communicator))
        return "No condition acts on the nodes there: give the boundary one, or enlarge the mesh where material is to "
               "fly on.";
      if (chosen("Kernel", "Type") == "P1")
      {
        const std::string fixed = smaller_steps();
        return "A condition acts on the nodes there, but not now, or the particle was too fast: " +
               (fixed.empty() ? "lower the Courant number." : "take " + fixed + '.');
      }
      return "A condition acts on the nodes there, but other nodes move what lies between them and press it through a "
             "wall at which the mesh ends. Name the wall in 'No-slip mirrors' or 'Slip mirrors' of section 'Grid' if "
             "it lies across an axis, else in 'Held boundaries'.";
    }
  } // namespace

  template <int dim>
  std::string remedy_of_instability(const Model<dim> &model)
  {
    const std::string fixed = smaller_steps();
    std::string       text  = fixed.empty() ? "Lower the Courant number" : "Take " + fixed;
    const auto        form  = model.kernel->product_form();
    if (form && std::holds_alternative<LinearFunction>(form->function))
      return (fixed.empty() ? "Take" : text + ", and take") +
             std::string(" a B-spline ('Type = quadratic B-spline' in section 'Kernel'): linear kernels are unstable "
                         "where particles pass the nodes, at any Courant number.");
    const std::string treatment = form ? chosen("Kernel", "Boundary treatment") : "";
    if (treatment == "none" || treatment == "Steffen")
      text += ", or take complete kernels at the faces: 'Boundary treatment = ghost nodes'";
    return text + ".";
  }

  template <int dim>
  std::string remedy_of_exit(const Model<dim> &model, const Tensor<1, dim> &x)
  {
    unsigned int face = 2 * dim;
    double       most = 0;
    for (unsigned int d = 0; d < dim; ++d)
      for (const double beyond : {model.grid.lower[d] - x[d], x[d] - model.grid.upper[d]})
        if (beyond > most)
        {
          most = beyond;
          face = 2 * d + (x[d] > model.grid.upper[d]);
        }
    if (face == 2 * dim) // not a number
      return remedy_of_instability(model);

    const auto box = dynamic_cast<const BoxGrid<dim> *>(&model.grid);
    if (box == nullptr)
      return remedy_of_exit_from_mesh(model, Point<dim>(x));
    const auto              of_face = box->nodes_on_boundary(face);
    const std::vector<bool> is_held = held_nodes(model);
    // Edges of the face are those of others as well, and have their conditions.
    unsigned int n_held = 0;
    for (const unsigned int i : of_face)
      n_held += is_held[i] && !box->is_on_other_face(i, face / 2);
    const std::string name = std::string(1, "xyz"[face / 2]) + (face % 2 == 0 ? "-" : "+");
    if (Utilities::MPI::sum(n_held, model.grid.communicator) == 0)
      return "The face " + name + " has no condition: give it one with 'Boundary ids = " + std::to_string(face) +
             "'. Enlarge the grid where material is to fly on.";
    const std::string fixed = smaller_steps();
    return "The face " + name +
           " has a condition, but not everywhere, or not now, or the particle was too fast: enlarge " +
           "the grid, or " + (fixed.empty() ? "lower the Courant number." : "take " + fixed + ".");
  }

#define INSTANTIATE(dim)                                                                                               \
  template std::string remedy_of_instability(const Model<dim> &);                                                      \
  template std::string remedy_of_exit(const Model<dim> &, const Tensor<1, dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus
