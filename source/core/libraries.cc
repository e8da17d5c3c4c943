#include <talus/core/libraries.h>

#include <deal.II/base/utilities.h>

#include <dlfcn.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    const std::string entry = "Additional shared libraries";

    /** Why the dynamic linker cannot load it; a name without a slash would be looked for where the system's are. */
    std::string load(const std::string &name)
    {
      const std::string path = name.find('/') == std::string::npos ? "./" + name : name;
      if (dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL) != nullptr)
        return "";
      const char *said = dlerror();
      return said == nullptr ? "unknown error" : said;
    }
  } // namespace

  void load_libraries(const Parameters &parameters)
  {
    for (const auto &name : Utilities::split_string_list(parameters.value("", entry, "")))
    {
      std::string problem;
      try
      {
        problem = load(name);
      }
      catch (const ExceptionBase &error) // a registration of it has failed
      {
        const auto *input = dynamic_cast<const InputError *>(&error);
        problem           = input != nullptr ? input->message : "it registers a name that is taken";
      }
      if (!problem.empty())
        throw EntryError("", entry,
                         "cannot load '" + name + "': " + shortened(problem, 300) +
                           ". Give the path of a library that was built against this version of Talus.");
    }
  }

  void declare_libraries()
  {
    ParameterAcceptor::prm.declare_entry(
      entry, "", Patterns::List(Patterns::FileName()),
      "Libraries with materials, kernels, conditions, ... of your own, which are loaded first: paths of .so files.");
  }
} // namespace Talus
