#include <talus/simulation/element_stage.h>

#include <cmath>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  ElementStage::ElementStage(Parameters &parameters, const std::string &section, const std::string &name) :
    ParameterAcceptor(section), name(name)
  {
    kind = parameters.choose_from(
      section, "Path", "triaxial", "triaxial|undrained triaxial|oedometer|biaxial|isotropic|simple shear|strain|stress",
      "triaxial: stresses xx, yy are held; undrained triaxial: the volume is; oedometer: no strain across z; biaxial: "
      "no strain yy, stress xx is held; isotropic: as much in x, y, z; simple shear: dv_x/dy; strain: a direction of "
      "one's own; stress: to a given one.");
    add_parameter("Steps", n_steps_of_leg, "Steps to each value of the list, or to the final stress [1].", prm,
                  Patterns::Integer(1, 100000000));
    if (kind == "stress")
      add_stress_entries(parameters);
    else
      add_strain_entries(parameters);
  }

  void ElementStage::add_strain_entries(Parameters &parameters)
  {
    const std::string section = get_section_name();
    add_parameter("Strain", turning_points,
                  "Values of the strain that are gone through, from 0 when the stage begins: logarithmic along z, "
                  "negative in compression; of 'simple shear' F_xy; of 'strain' the factor of the direction [1].",
                  prm, Patterns::List(Patterns::Double(), 1, 10000));
    add_parameter("Strain rate", rate, "How fast the strain goes, for viscous laws and the column of times [1/time].",
                  prm, Patterns::Double());
    if (kind == "strain")
      add_direction_entries();
    else
      for (const char *entry : {"Direction", "Held stresses"})
        parameters.allow(section, entry, "only 'Path = strain' reads it.");
    for (const char *entry : {"Final stress", "Duration"})
      parameters.allow(section, entry, "only 'Path = stress' reads it.");
  }

  void ElementStage::add_direction_entries()
  {
    add_parameter("Direction", direction, "D in grad v = strain rate times D, row by row: xx, xy, xz, yx, ..., zz [1].",
                  prm, Patterns::List(Patterns::Double(), 0, 9));
    add_parameter("Held stresses", held_names,
                  "Stresses that keep the values they have when the stage begins; the strains of these components, "
                  "which the direction leaves 0, adjust themselves.",
                  prm, Patterns::List(Patterns::Selection("xx|yy|zz|xy|xz|yz"), 0, 6));
  }

  void ElementStage::add_stress_entries(Parameters &parameters)
  {
    add_parameter("Final stress", final_stress,
                  "Stress xx, yy, zz, xy, xz, yz at the end, tension positive; each goes there linearly [stress].", prm,
                  Patterns::List(Patterns::Double(), 6, 6));
    add_parameter("Duration", duration, "How long the stress takes [time].", prm, Patterns::Double());
    for (const char *entry : {"Strain", "Strain rate", "Direction", "Held stresses"})
      parameters.allow(get_section_name(), entry, "'Path = stress' prescribes no strain.");
  }

  void ElementStage::parse_parameters(ParameterHandler &)
  {
    const auto check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    if (kind == "stress")
    {
      check(duration > 0 && std::isfinite(duration), "Duration", "it must be positive.");
      held = {0, 1, 2, 3, 4, 5};
      for (const double component : final_stress)
        check(std::isfinite(component), "Final stress", "give finite numbers.");
      return;
    }
    check(rate > 0 && std::isfinite(rate), "Strain rate",
          "it must be positive; the signs of the strains say which way they go.");
    double before = 0;
    for (const double strain : turning_points)
    {
      check(std::isfinite(strain), "Strain", "give finite numbers.");
      check(strain != before, "Strain", "each value must differ from the one before, the first from 0.");
      check(kind == "strain" || kind == "simple shear" || std::abs(strain) < 50, "Strain",
            "exp of it is no stretch of a body. Give logarithmic strains, not percentages; negative is compression.");
      before = strain;
    }
    if (kind == "strain")
      check_direction();
    held = kind == "triaxial" ? std::vector<unsigned>{0, 1} : kind == "biaxial" ? std::vector<unsigned>{0} : held;
  }

  void ElementStage::check_direction()
  {
    bool is_nothing = true;
    for (const double component : direction)
    {
      if (!std::isfinite(component))
        throw EntryError(get_section_name(), "Direction", "give finite numbers.");
      is_nothing = is_nothing && component == 0;
    }
    if (direction.size() != 9 || is_nothing)
      throw EntryError(get_section_name(), "Direction",
                       "give 9 numbers, row by row, not all 0: 0,0,0, 0,0,0, 0,0,-1 compresses along z.");
    held.clear();
    for (const std::string &component : held_names)
    {
      const auto &names = component_names_of_stress;
      const auto  c     = static_cast<unsigned int>(std::find(names.begin(), names.end(), component) - names.begin());
      const auto  ij    = SymmetricTensor<2, 3>::unrolled_to_component_indices(c);
      if (std::find(held.begin(), held.end(), c) != held.end())
        throw EntryError(get_section_name(), "Held stresses", "'" + component + "' stands there twice.");
      if (direction[3 * ij[0] + ij[1]] != 0 || direction[3 * ij[1] + ij[0]] != 0)
        throw EntryError(get_section_name(), "Held stresses",
                         "'" + component +
                           "' can not be held while 'Direction' drives its strain. Set it to 0 there, or do not hold "
                           "it.");
      held.push_back(c);
    }
  }

  double ElementStage::amount(const unsigned int k) const
  {
    if (kind == "stress")
      return static_cast<double>(k) / n_steps_of_leg;
    if (k == 0)
      return 0;
    const unsigned int leg   = (k - 1) / n_steps_of_leg;
    const double       from  = leg == 0 ? 0. : turning_points[leg - 1];
    const double       share = static_cast<double>(k - leg * n_steps_of_leg) / n_steps_of_leg;
    return from + share * (turning_points[leg] - from);
  }

  Tensor<2, 3> ElementStage::driven(const double d) const
  {
    Tensor<2, 3> increment;
    if (kind == "simple shear")
      increment[0][1] = d;
    else if (kind == "strain")
      for (unsigned int c = 0; c < 9; ++c)
        increment[c / 3][c % 3] = d * direction[c];
    else if (kind != "stress")
      increment[2][2] = std::expm1(d);
    if (kind == "isotropic")
      increment[0][0] = increment[1][1] = increment[2][2];
    if (kind == "undrained triaxial")
      increment[0][0] = increment[1][1] = std::expm1(-d / 2);
    return increment;
  }

  ElementStep ElementStage::step(const unsigned int k, const std::array<double, 6> &start) const
  {
    ElementStep  step;
    const double d = amount(k) - amount(k - 1);
    step.driven    = driven(d);
    step.dt        = kind == "stress" ? duration / n_steps_of_leg : std::abs(d) / rate;
    step.held      = held;
    step.target    = start;
    if (kind == "stress")
      for (unsigned int c = 0; c < 6; ++c)
        step.target[c] += amount(k) * (final_stress[c] - start[c]);
    return step;
  }

  std::string ElementStage::summary() const
  {
    std::ostringstream text;
    text << kind;
    for (unsigned int leg = 1; leg <= legs() && kind != "stress"; ++leg)
      text << (leg == 1 ? " to " : ", ") << turning_points[leg - 1];
    text << " in " << n_steps() << " steps";
    return text.str();
  }

  std::string ElementStage::amount_name() const
  {
    return kind == "simple shear" ? "shear" : kind == "strain" ? "factor" : kind == "stress" ? "share" : "strain zz";
  }
} // namespace Talus
