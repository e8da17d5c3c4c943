#include <talus/core/eigen.h>
#include <talus/steppers/fracture_watch.h>

#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void FractureWatch<dim>::start(const Model<dim> &model)
  {
    const auto form = model.kernel->product_form();
    is_watching     = form.has_value() && !model.transfer->reach(*model.kernel).at_corners;
    if (!is_watching)
      return;
    reach = std::visit([](const auto &function) { return 2 * function.support() - 1; }, form->function);
    spacings.assign(model.bodies.size(), 0.);
    for (unsigned int p = 0; p < model.particles.size(); ++p)
    {
      double &spacing = spacings[model.particles.body[p]];
      spacing         = std::max(spacing, model.particles.component(model.particles.volume, 0)[p]);
    }
    Utilities::MPI::max(spacings, model.grid.communicator, spacings);
    is_solid.clear();
    for (unsigned int b = 0; b < spacings.size(); ++b)
    {
      spacings[b] = std::pow(spacings[b], 1. / dim);
      is_solid.push_back(model.materials[model.bodies[b]->material]->bears_tension());
    }
  }

  template <int dim>
  double FractureWatch<dim>::spacing(const Model<dim> &model, const unsigned int p) const
  {
    const auto  &particles = model.particles;
    const double volume = particles.component(particles.volume, 0)[p] / determinant(particles.matrix(particles.F, p));
    return std::pow(volume, 1. / dim);
  }

  namespace
  {
    /** At least the square of the largest principal stretch, and that where F is diagonal: Gershgorin's for F F^T. */
    template <int dim>
    double bound_of_squares(const Tensor<2, dim> &F)
    {
      const Tensor<2, dim> b     = F * transpose(F);
      double               bound = 0;
      for (unsigned int i = 0; i < dim; ++i)
      {
        double sum = 0;
        for (unsigned int j = 0; j < dim; ++j)
          sum += std::abs(b[i][j]);
        bound = std::max(bound, sum);
      }
      return bound;
    }
  } // namespace

  template <int dim>
  template <class Visitor>
  void FractureWatch<dim>::for_each_beyond(const Model<dim> &model, const double &least, const Visitor &visitor) const
  {
    const auto F = model.particles.template components<dim * dim>(model.particles.F);
    const auto h = model.grid.smallest_spacing;
    for (unsigned int p = 0; p < model.particles.size(); ++p)
    {
      // The largest principal stretch is at most the norm of F, which a body at rest exceeds.
      const unsigned int b      = model.particles.body[p];
      double             square = 0;
      for (const double *component : F)
        square += component[p] * component[p];
      const double scale = least * reach * h / spacings[b];
      if (square > scale * scale && is_solid[b] &&
          bound_of_squares<dim>(model.particles.matrix(model.particles.F, p)) > scale * scale * (1 + 1e-12))
        visitor(p);
    }
  }

  template <int dim>
  Tensor<1, dim> FractureWatch<dim>::neighbour(const Model<dim> &model, const unsigned int p) const
  {
    const auto F      = model.particles.matrix(model.particles.F, p);
    const auto system = eigen_system<dim>(symmetrize(F * transpose(F)));
    // The direction of the greatest stretch.
    unsigned int a = 0;
    for (unsigned int b = 1; b < dim; ++b)
      if (system.value[b] > system.value[a])
        a = b;
    Tensor<1, dim> direction;
    for (unsigned int d = 0; d < dim; ++d)
      direction[d] = system.vector[d][a];
    return std::sqrt(std::max(system.value[a], 0.)) * spacing(model, p) * direction;
  }

  template <int dim>
  double FractureWatch<dim>::ratio(const Model<dim> &model, const Tensor<1, dim> &neighbour) const
  {
    double square = 0;
    for (unsigned int d = 0; d < dim; ++d)
      square += neighbour[d] * neighbour[d] * model.grid.inverse_spacing[d] * model.grid.inverse_spacing[d];
    return std::sqrt(square) / reach;
  }

  template <int dim>
  bool FractureWatch<dim>::has_gaps(const Model<dim> &model, const unsigned int p,
                                    const Tensor<1, dim> &neighbour) const
  {
    const auto box = dynamic_cast<const BoxGrid<dim> *>(&model.grid);
    if (box == nullptr)
      return false; // on a mesh nobody looks between the particles
    const auto mass_at = [&](const Tensor<1, dim> &x) {
      double mass = 0;
      box->for_each_corner(x, [&](const unsigned int node, const double weight) {
        mass += weight * model.grid.fields[node][NodalFields<dim>::mass];
      });
      return mass;
    };
    const auto   x    = model.particles.vector(model.particles.position, p);
    const double here = mass_at(x);
    return std::max(mass_at(x + 0.5 * neighbour), mass_at(x - 0.5 * neighbour)) < 0.5 * here;
  }

  template <int dim>
  void FractureWatch<dim>::measure(const Model<dim> &model)
  {
    distance = 0;
    if (is_watching)
      for_each_beyond(model, distance,
                      [&](const unsigned int p) { distance = std::max(distance, ratio(model, neighbour(model, p))); });
    distance = Utilities::MPI::max(distance, model.grid.communicator);
  }

  template <int dim>
  std::string FractureWatch<dim>::look(const Model<dim> &model)
  {
    if (!is_watching || has_told)
      return "";
    using Found = std::pair<types::particle_index, std::string>;
    Found found(std::numeric_limits<types::particle_index>::max(), "");
    for_each_beyond(model, 1., [&](const unsigned int p) {
      const auto towards = neighbour(model, p);
      if (model.particles.id[p] > found.first || !(ratio(model, towards) > 1) || !has_gaps(model, p, towards))
        return;
      const unsigned int b = model.particles.body[p];
      std::ostringstream text;
      text << "the body '" << model.bodies[b]->name << "' comes apart (numerical fracture): at "
           << to_text(model.particles.vector(model.particles.position, p)) << " it is stretched "
           << towards.norm() / spacing(model, p) << "-fold, and neighbours " << ratio(model, towards) * reach
           << " spacings apart are beyond the kernel's reach of " << reach;
      found = {model.particles.id[p], text.str()};
    });
    for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, found))
      found = std::min(found, other);
    has_told = !found.second.empty();
    return found.second;
  }

  template class FractureWatch<2>;
  template class FractureWatch<3>;
} // namespace Talus
