#include <talus/boundary/condition.h>
#include <talus/core/registry.h>
#include <talus/kernels/kernel.h>
#include <talus/grid/contact_surface.h>
#include <talus/materials/material.h>
#include <talus/particles/shape.h>
#include <talus/simulation/list.h>
#include <talus/steppers/stepper.h>
#include <talus/transfer/transfer.h>
#include <talus/verification/manufactured_solution.h>

#include <iomanip>

namespace Talus
{
  namespace
  {
    template <class Interface>
    void list(std::ostream &out, const std::string &kind)
    {
      for (const auto &[name, entry] : Registry<Interface>::get().all())
        out << std::left << std::setw(20) << kind << std::setw(22) << name << entry.help << '\n';
    }
  } // namespace

  void list_registered(std::ostream &out)
  {
    list<Kernel<2>>(out, "kernel");
    list<Treatment<2>>(out, "boundary treatment");
    list<Transfer<2>>(out, "transfer");
    list<Material>(out, "material");
    list<Shape<2>>(out, "shape");
    list<Condition<2>>(out, "condition");
    list<ContactSurface<2>>(out, "surface");
    list<Stepper<2>>(out, "stepper");
    list<ManufacturedSolution<2>>(out, "solution");
  }
} // namespace Talus
