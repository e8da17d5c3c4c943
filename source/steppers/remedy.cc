#include <talus/steppers/remedy.h>

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
      return "Give the boundary there a condition, enlarge the mesh, or take smaller steps.";
    const auto        of_face = box->nodes_on_boundary(face);
    std::vector<bool> is_held(model.grid.fields.n_owned(), false);
    for (const auto &condition : model.boundary.conditions)
      for (const auto &list : condition->owned_nodes())
        for (const unsigned int i : list)
          is_held[i] = true;
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
