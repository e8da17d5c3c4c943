#pragma once

#include <talus/simulation/element_point.h>

#include <string>
#include <vector>

namespace Talus
{
  /** Places among the components of a stress, "xx" .. "yz". */
  extern const std::array<const char *, 6> component_names_of_stress;

  /**
   * What a step asks of a point: a part of its motion, and values of some stresses, for which the strains of the same
   * components adjust themselves. One of them has a strain each: together they say all of a symmetric grad v.
   */
  struct ElementStep
  {
    dealii::Tensor<2, 3>      driven; // of dt grad v [1]
    double                    dt = 0; // [time]
    std::vector<unsigned int> held;   // components of the stress
    std::array<double, 6>     target{};
  };

  /**
   * Takes steps whose held stresses it meets to 1e-11 of what the stress is made of, the greatest stress or modulus
   * times strain: Newton's method on the strains of these components with a Jacobian by differences, which starts where
   * the last step has ended. Where a stress can not change (on an edge of a yield surface, which two of them share),
   * the least change of strain is taken, by Levenberg and Marquardt's term. Test: tests/element.
   */
  class ElementControl
  {
  public:
    /**
     * Advances the point; the strains that were found are the guess for the next step. What is wrong, or nothing; where
     * something is, the point stays as it was.
     */
    std::string advance(ElementPoint &point, const ElementStep &step);

    /** Forgets the strains of the last step: the next goes elsewhere. */
    void restart() { strains.clear(); }

  private:
    struct Trial
    {
      ElementPoint        point;
      std::vector<double> rest; // stress less target
      double              size; // sqrt of the sum of its squares; infinite where the step turns the point inside out
    };

    Trial attempt(const ElementPoint &start, const ElementStep &step, const std::vector<double> &x) const;

    /** Change of strains by which the rest should vanish; `size` is that of strains. */
    std::vector<double> correction(const ElementPoint &start, const ElementStep &step, const std::vector<double> &x,
                                   const Trial &now, const double size) const;

    /** Goes from x towards x + change until the rest is less; false where it does not get less. */
    bool search(const ElementPoint &start, const ElementStep &step, const std::vector<double> &change,
                std::vector<double> &x, Trial &now) const;

    /** Newton's method from x; whether the held stresses are met. */
    bool converge(const ElementPoint &start, const ElementStep &step, std::vector<double> &x, Trial &now) const;

    /** The same by growing parts of the step, each from the strains of the one before. */
    bool creep(const ElementPoint &start, const ElementStep &step, const unsigned int n_parts, std::vector<double> &x,
               Trial &now) const;

    std::vector<double> strains; // of the held components in the last step
  };
} // namespace Talus
