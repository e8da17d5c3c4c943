#include <talus/core/registry.h>
#include <talus/verification/ring_expansion.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** radial e_r (x) e_r + tangential e_t (x) e_t at X. */
    template <int dim>
    Tensor<2, dim> polar_matrix(const Point<dim> &X, const double radial, const double tangential)
    {
      const double   R = std::hypot(X[0], X[1]), c = X[0] / R, s = X[1] / R;
      Tensor<2, dim> result;
      result[0][0] = radial * c * c + tangential * s * s;
      result[1][1] = radial * s * s + tangential * c * c;
      result[0][1] = result[1][0] = (radial - tangential) * c * s;
      return result;
    }

    /** The part of X in the plane times a factor. */
    template <int dim>
    Tensor<1, dim> radial_vector(const Point<dim> &X, const double factor)
    {
      Tensor<1, dim> result;
      result[0] = factor * X[0];
      result[1] = factor * X[1];
      return result;
    }
  } // namespace

  template <int dim>
  RingExpansion<dim>::RingExpansion(const std::string &section) : StandingWave<dim>(section)
  {
    this->add_parameter("Amplitude", amplitude, "A of the displacement A sin(pi c t / (r_i + r_o)) g(R) [length].",
                        this->prm, Patterns::Double());
    this->add_parameter("Inner radius", inner, "Radius r_i of the ring around the z axis [length].", this->prm,
                        Patterns::Double());
    this->add_parameter("Outer radius", outer, "Its outer radius r_o [length].", this->prm, Patterns::Double());
  }

  template <int dim>
  void RingExpansion<dim>::parse_parameters(ParameterHandler &)
  {
    if (!(inner > 0 && outer > inner))
      throw EntryError(this->get_section_name(), "Outer radius", "it must be greater than the inner one, that than 0.");
    const double denominator = outer * outer * (outer - 3 * inner);
    if (!(std::abs(denominator) > 1e-6 * outer * outer * outer))
      throw EntryError(this->get_section_name(), "Outer radius",
                       "there is no such solution for r_o = 3 r_i. Take another ratio of the radii.");
    // Eq. (59): g' = 0 at both rims, g(r_o) = 1.
    c1 = -6 * inner * outer / denominator;
    c2 = 3 * (inner + outer) / denominator;
    c3 = -2 / denominator;
  }

  template <int dim>
  void RingExpansion<dim>::check(const NeoHookeanConstants &material) const
  {
    if (!(std::abs(material.lambda) <= 1e-12 * material.mu))
      throw EntryError(this->get_section_name(), "Solution",
                       "the rims of the ring are free of traction for lambda = 0 alone. Set Poisson's ratio to 0.");
  }

  template <int dim>
  Tensor<1, dim> RingExpansion<dim>::shape(const Point &X) const
  {
    const double R = std::hypot(X[0], X[1]);
    return radial_vector(X, amplitude * ratio(R));
  }

  template <int dim>
  Tensor<2, dim> RingExpansion<dim>::shape_gradient(const Point &X) const
  {
    const double R = std::hypot(X[0], X[1]);
    return polar_matrix(X, amplitude * slope(R), amplitude * ratio(R));
  }

  template <int dim>
  Tensor<1, dim> RingExpansion<dim>::body_force(const Point &X, const double t) const
  {
    const auto &[lambda, mu, density] = this->material;
    const double R = std::hypot(X[0], X[1]), A = amplitude * this->sine(t).value;
    const double u = A * ratio(R) * R, u_R = A * slope(R), u_RR = A * (6 * c3 * R + 2 * c2);
    const double F_r = 1 + u_R, F_t = 1 + u / R, log_J = std::log(F_r * F_t);
    const double log_J_R = u_RR / F_r + (u_R - u / R) / (R * F_t);
    const double P_r = lambda * log_J / F_r + mu * (F_r - 1 / F_r), P_t = lambda * log_J / F_t + mu * (F_t - 1 / F_t);
    const double P_r_R = lambda * (log_J_R / F_r - log_J * u_RR / (F_r * F_r)) + mu * u_RR * (1 + 1 / (F_r * F_r));
    const double acceleration = amplitude * this->sine(t).second * ratio(R) * R;
    return radial_vector(X, (acceleration - (P_r_R + (P_r - P_t) / R) / density) / R);
  }

  template class RingExpansion<2>;
  template class RingExpansion<3>;

  namespace
  {
    const RegisterDimensions<ManufacturedSolution, RingExpansion> registration("ring", "radial expansion of a ring");
  }
} // namespace Talus
