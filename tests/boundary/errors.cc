#include "moved_nodes.h"

using namespace Test;

template <int dim>
void boundary_errors()
{
  const auto error = [](const std::string &name, const std::string &text, const std::string &entry,
                        const std::string &message) {
    check_error<EntryError>(name, {"/Conditions/one: " + entry, message}, [&] {
      Setup<dim> s(section("Grid", set("Spacing", "0.25")) + conditions("one", section("one", text)));
    });
  };
  error("nowhere", set("Type", "no-slip"), "Boundary ids", "acts nowhere");
  error("slip in a box",
        set("Type", "slip") + set("Lower corner", coordinates<dim>({{0, 0, 0}})) +
          set("Upper corner", coordinates<dim>({{1, 1, 1}})),
        "Boundary ids", "slip needs the faces");
  for (const std::string bad : {"x < 0.5", "x <= half", "w <= 0.5", "x <= nan", "x 0.5"})
    error("half space " + bad, set("Type", "slip") + set("Half spaces", bad), "Half spaces", "cannot understand");
  error("half space outside", set("Type", "slip") + set("Half spaces", "x >= 0, y <= -0.1"), "Half spaces",
        "no node of the grid lies in 'y <= -0.1'");
  error("one corner", set("Type", "no-slip") + set("Lower corner", coordinates<dim>({{0, 0, 0}})), "Lower corner",
        "both corners");
  error("box between the nodes",
        set("Type", "no-slip") + set("Lower corner", coordinates<dim>({{0.1, 0.1, 0.1}})) +
          set("Upper corner", coordinates<dim>({{0.2, 0.2, 0.2}})),
        "Lower corner", "no node of the grid");
  error("friction in a box",
        set("Type", "friction") + set("Lower corner", coordinates<dim>({{0, 0, 0}})) +
          set("Upper corner", coordinates<dim>({{1, 1, 1}})),
        "Boundary ids", "friction needs the faces");
  error("negative friction", set("Type", "friction") + set("Boundary ids", "0") + set("Friction coefficient", "-1"),
        "Friction coefficient", "must not be negative");
  error("no interval", set("Boundary ids", "0") + set("Start time", "2") + set("End time", "1"), "End time",
        "never acts");
  error("bad expression", set("Type", "velocity") + set("Boundary ids", "0") + set("Velocity", "1"), "Velocity",
        "expressions");
}

template void boundary_errors<2>();
template void boundary_errors<3>();
