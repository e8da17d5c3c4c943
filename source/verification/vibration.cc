#include <talus/core/registry.h>
#include <talus/verification/vibration.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Vibration<dim>::Vibration(const std::string &section) : StandingWave<dim>(section)
  {
    this->add_parameter("Amplitude", amplitude, "Greatest displacement A [length].", this->prm, Patterns::Double());
    this->add_parameter("Length", length, "Edge L of the box, which begins at the origin [length].", this->prm,
                        Patterns::Double());
    this->add_parameter("Wave number", wave_number, "Half waves k along an edge [1]: sin(k pi X / L).", this->prm,
                        Patterns::Double());
    this->add_parameter("Directions", directions, "Axes along which it moves; 'x' alone is a bar.", this->prm,
                        Patterns::List(Patterns::Selection(dim == 2 ? "x|y" : "x|y|z"), 1, dim));
  }

  template <int dim>
  void Vibration<dim>::parse_parameters(ParameterHandler &)
  {
    if (!(length > 0))
      throw EntryError(this->get_section_name(), "Length", "it must be positive.");
    if (!(std::abs(amplitude) * k() < 1))
      throw EntryError(this->get_section_name(), "Amplitude",
                       "the body would be turned inside out: A k pi / L must lie below 1, and is " +
                         std::to_string(std::abs(amplitude) * k()) + ". Take a smaller amplitude.");
    for (unsigned int d = 0; d < dim; ++d)
      amplitudes[d] = directions.find("xyz"[d]) == std::string::npos ? 0 : d == 1 ? -amplitude : amplitude;
  }

  template <int dim>
  Tensor<1, dim> Vibration<dim>::shape(const Point &X) const
  {
    Vector U;
    for (unsigned int d = 0; d < dim; ++d)
      U[d] = amplitudes[d] * std::sin(k() * X[d]);
    return U;
  }

  template <int dim>
  Tensor<2, dim> Vibration<dim>::shape_gradient(const Point &X) const
  {
    Matrix gradient;
    for (unsigned int d = 0; d < dim; ++d)
      gradient[d][d] = amplitudes[d] * k() * std::cos(k() * X[d]);
    return gradient;
  }

  template <int dim>
  Tensor<1, dim> Vibration<dim>::body_force(const Point &X, const double t) const
  {
    const auto &[lambda, mu, density] = this->material;
    const Matrix F                    = this->deformation_gradient(X, t);
    const double log_J                = std::log(determinant(F));
    Vector       b                    = this->displacement(X, t);
    for (unsigned int d = 0; d < dim; ++d)
      b[d] *= k() * k() * (mu - (lambda * (log_J - 1) - mu) / (F[d][d] * F[d][d])) / density - omega() * omega();
    return b;
  }

  template class Vibration<2>;
  template class Vibration<3>;

  namespace
  {
    const RegisterDimensions<ManufacturedSolution, Vibration> registration("vibration",
                                                                           "axis-aligned vibration of a box");
  }
} // namespace Talus
