#include "../setup.h"

#include <cstdio>
#include <algorithm>
#include <fstream>

using namespace Test;
using namespace dealii;

namespace
{
  /** An object with one entry of each sort and a rule of its own. */
  class Spring : public ParameterAcceptor
  {
  public:
    explicit Spring(const std::string &section) : ParameterAcceptor(section)
    {
      add_parameter("Stiffness", stiffness, "Force per length [force/length].", prm, Patterns::Double(0, 100));
      add_parameter("Turns", turns, "Number of turns [1].", prm, Patterns::Integer(1));
      add_parameter("Colour", colour, "Colour of the paint.", prm, Patterns::Selection("red|green"));
    }
    void parse_parameters(ParameterHandler &) override
    {
      if (stiffness == 13)
        throw EntryError(get_section_name(), "Stiffness", "it must not be 13. Use 12.");
    }

    double      stiffness = 1;
    int         turns     = 5;
    std::string colour    = "red";
  };

  /** Reads a text for one spring in section "Springs/first". */
  void read(const std::string &text)
  {
    auto   parameters = Parameters::from_text(text);
    Spring spring("/Springs/first");
    parameters.names("/Springs", "Names of the springs.");
    parameters.parse();
  }

  std::string spring(const std::string &content)
  {
    return "subsection Springs\nsubsection first\n" + content + "end\nend\n";
  }

  void error(const std::string &name, const std::vector<std::string> &parts, const std::string &text)
  {
    check_error<InputError>(name, parts, [&] { read(text); });
  }

  /** A file of this rank that lives as long as the object. */
  struct File
  {
    File(const std::string &stem, const std::string &content) :
      name(stem + std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".prm")
    {
      std::ofstream(name) << content;
    }
    ~File() { std::remove(name.c_str()); }

    std::string name;
  };
} // namespace

void syntax_errors()
{
  error("set twice", {"text:4: ", "'Turns'", "'Springs/first'", "set before, at text:3", "Remove one"},
        spring("set Turns = 1\nset Turns = 1\n"));
  error("set twice in two blocks of one section", {"text:8: ", "set before, at text:3"},
        spring("set Turns = 1\n") + spring("set Turns = 2\n"));
  error("missing end", {"text:2: ", "'first' is never closed", "Add 'end'"}, "subsection Springs\nsubsection first\n");
  error("missing end of the outer section", {"text:1: ", "'Springs' is never closed"},
        "subsection Springs\nsubsection first\nend\n");
  error("end too many", {"text:6: ", "closes no subsection"}, spring("") + "\nend\n");
  error("word after end", {"text:3: ", "nothing may follow 'end'"}, "subsection Springs\n\nend it\n");
  error("no equal sign", {"text:3: ", "expected 'set entry = value'", "set Turns 4"}, spring("set Turns 4\n"));
  error("not a keyword", {"text:3: ", "cannot understand 'sett Turns = 4'"}, spring("sett Turns = 4\n"));
  error("subsection without name", {"text:1: ", "needs a name"}, "subsection\nend\n");
  error("continued line counts", {"text:5: ", "unknown entry 'Tunrs'"}, spring("set Turns = \\\n 4\nset Tunrs = 1\n"));
  read(spring("# set Turns = 0\nset Turns = 4 # turns\n  SET Stiffness=2\n"));
  check_true("comments, case of keywords and spaces", true);
}

void value_errors()
{
  error("misspelt choice in an entry", {"text:3: ", "'Colour'", "'rde' is not a valid value", "red", "green"},
        spring("set Colour = rde\n"));
  error("above the bound", {"text:3: ", "'Stiffness'", "'101' is not a valid value", "between 0 and 100"},
        spring("set Stiffness = 101\n"));
  error("below the bound", {"text:3: ", "'-1' is not a valid value"}, spring("set Stiffness = -1\n"));
  error("fraction for a whole number", {"text:3: ", "'2.5' is not a valid value"}, spring("set Turns = 2.5\n"));
  error("word for a number", {"text:3: ", "'soft' is not a valid value"}, spring("set Stiffness = soft\n"));
  error("NaN", {"text:3: ", "'nan' is not a valid value"}, spring("set Stiffness = nan\n"));
  error("nothing", {"text:3: ", "'' is not a valid value"}, spring("set Stiffness =\n"));

  const std::string kernel = "subsection Kernel\nset Type = quadratic B-splin\nend\n";
  check_error<InputError>("misspelt choice of an object",
                          {"text:2: ", "'Type'", "'Kernel'", "there is no 'quadratic B-splin'",
                           "Did you mean 'quadratic B-spline'?", "Choices: ", "uGIMP"},
                          [&] { Parameters::from_text(kernel).make<Kernel<2>>("/Kernel", "Type", "linear", ""); });
}

void unknown_entries()
{
  error("misspelt entry",
        {"text:3: ", "unknown entry 'Stifness'", "Did you mean 'Stiffness'?", "Colour, Stiffness, Turns"},
        spring("set Stifness = 1\n"));
  error("unlike any entry", {"text:3: ", "unknown entry 'Mass of the sun'", "Known there"},
        spring("set Mass of the sun = 1\n"));
  error("section of an object that is not listed",
        {"text:3: ", "nothing reads the section 'Springs/secnd'", "list 'secnd' in 'Names' of section 'Springs'"},
        "subsection Springs\nsubsection secnd\nset Turns = 1\nend\nend\n");
  error("misspelt section", {"text:2: ", "nothing reads the section 'Sprins'", "Did you mean 'Springs'?"},
        "subsection Sprins\nset Names = first\nend\n");
}

void overrides()
{
  const File file("overrides", spring("set Turns = 3\nset Stiffness = 2\n"));
  const auto parse = [&](const std::vector<std::string> &overrides) {
    Parameters parameters(file.name, overrides);
    Spring     spring("/Springs/first");
    parameters.parse();
    return std::make_pair(spring.turns, spring.stiffness);
  };
  check_true("file alone", parse({}) == std::make_pair(3, 2.));
  check_true("override wins", parse({"Springs/first/Turns = 7"}) == std::make_pair(7, 2.));
  check_true("last override wins",
             parse({"Springs/first/Turns = 7", "/Springs/first/Turns=8"}) == std::make_pair(8, 2.));
  const auto error = [&](const std::string &name, const std::string &text, const std::vector<std::string> &parts) {
    check_error<InputError>(name, parts, [&] { parse({text}); });
  };
  error("no equal sign", "Springs/first/Turns 7", {"--set", "Springs/first/Turns 7", "Section/Entry = value"});
  error("unknown entry", "Springs/first/Turn = 7", {"--set", "unknown entry 'Turn'", "Did you mean 'Turns'?"});
  error("bad value", "Springs/first/Turns = x", {"--set", "'x' is not a valid value"});
  // An object that the file lists and --set leaves out may stay in the file; one that nobody lists may not.
  const File two("two", "subsection Springs\nset Names = first, second\nsubsection first\nset Turns = 3\nend\n"
                        "subsection second\nset Turns = 4\nend\nend\n");
  const auto parse_two = [&](const std::vector<std::string> &overrides) {
    Parameters parameters(two.name, overrides);
    parameters.names("/Springs", "");
    Spring spring("/Springs/first");
    parameters.parse();
    return spring.turns;
  };
  check_true("left out", parse_two({"Springs/Names = first"}) == 3);
  check_error<InputError>("not left out", {"nothing reads the section 'Springs/second'"}, [&] { parse_two({}); });
  check_error<InputError>("missing file", {"'missing.prm'", "Check the name"}, [] { Parameters("missing.prm"); });
  check_error<InputError>("a directory", {"'.'", "Check the name"}, [] { Parameters("."); });
}

void idle_entries()
{
  const File file("idle", spring("set Turns = 3\nset Stiffness = 2\n"));
  const auto declared = Parameters::declared_by([] { Spring spring("/Springs/first"); });
  check_true("declared by an object",
             std::find(declared.begin(), declared.end(), "Springs/first/Turns") != declared.end());
  {
    Parameters parameters(file.name);
    for (const auto &key : declared)
      parameters.allow("/Springs/first", key.substr(key.rfind('/') + 1));
    parameters.names("/Springs", "");
    parameters.parse();
    check_true("no warning", parameters.warnings().empty() && parameters.has_section("/Springs/first") &&
                               !parameters.has_section("/Spring") && parameters.is_set("/Springs/first", "Turns"));
  }
  Parameters parameters(file.name);
  parameters.allow("/Springs/first", "Turns", "nothing turns.");
  parameters.allow("/Springs/first", "Colour", "nothing is seen.");
  check_true("a reason is a warning",
             parameters.warnings().size() == 1 &&
               parameters.warnings()[0].find(
                 "entry 'Turns' in section 'Springs/first': it has no effect: nothing turns.") != std::string::npos);
  parameters.names("/Springs", "");
  check_error<InputError>("others are unknown", {"'Springs/first'"}, [&] { parameters.parse(); });
}

void included_files()
{
  const File inner("inner", spring("set Turns = 3\n"));
  const File outer("outer", "include " + inner.name + "\n");
  {
    Parameters parameters(outer.name);
    Spring     spring("/Springs/first");
    parameters.parse();
    check_true("values of an included file", spring.turns == 3);
  }
  const File twice("twice", spring("set Turns = 3\n") + "include " + inner.name + "\n");
  check_error<InputError>("set in both files", {inner.name + ":3: ", "set before, at " + twice.name + ":3"},
                          [&] { Parameters p(twice.name); });
  const File missing("missing", "\ninclude nothing.prm\n");
  check_error<InputError>("missing file", {missing.name + ":2: ", "'nothing.prm'"},
                          [&] { Parameters p(missing.name); });
  const File open("open", "subsection Springs\n");
  const File open_outer("open_outer", "include " + open.name + "\nend\n");
  check_error<InputError>("section left open", {open.name + ":1: ", "never closed"},
                          [&] { Parameters p(open_outer.name); });
  const File nameless("nameless", "include\n");
  check_error<InputError>("no name", {nameless.name + ":1: "}, [&] { Parameters p(nameless.name); });
  const File endless("endless",
                     "include endless" + std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".prm\n");
  check_error<InputError>("file that includes itself", {endless.name + ":1: "}, [&] { Parameters p(endless.name); });
}

/** An error found after reading gets the place where its entry was set. */
void located_errors()
{
  for (const bool is_set : {true, false})
  {
    auto        parameters = Parameters::from_text(is_set ? spring("set Stiffness = 13\n") : "");
    Spring      spring("/Springs/first");
    std::string message;
    try
    {
      parameters.parse();
      spring.stiffness = 13;
      spring.parse_parameters(ParameterAcceptor::prm);
    }
    catch (const EntryError &error)
    {
      message = parameters.locate(error);
    }
    if (is_set)
      check_true("set", message == "text:3: entry 'Stiffness' in section 'Springs/first': it must not be 13. Use 12.");
    else
      check_true("default",
                 message.find("text: entry 'Stiffness'") == 0 && message.find("default") != std::string::npos);
  }
}

/** What is printed can be read again and gives the same; help is there when asked for. */
void printing()
{
  std::ostringstream short_text, long_text;
  {
    auto   parameters = Parameters::from_text(spring("set Stiffness = 0.1\nset Turns = 9\n"));
    Spring spring("/Springs/first");
    parameters.parse();
    parameters.print(short_text, false);
    parameters.print(long_text, true);
  }
  check_true("help", long_text.str().find("Force per length [force/length].") != std::string::npos);
  check_true("no help", short_text.str().find("Force per length") == std::string::npos);
  auto   parameters = Parameters::from_text(short_text.str());
  Spring spring("/Springs/first");
  parameters.parse();
  check_true("read again", spring.stiffness == 0.1 && spring.turns == 9 && spring.colour == "red");
}

void names()
{
  const auto list = [](const std::string &value) {
    return Parameters::from_text("subsection Bodies\nset Names = " + value + "\nend\n").names("/Bodies", "");
  };
  check_true("two names", list("left, right") == std::vector<std::string>{"left", "right"});
  check_true("none", list("").empty());
  check_error<InputError>("twice", {"text:2: ", "'left' stands there twice"}, [&] { list("left, left"); });
  check_error<InputError>("slash", {"text:2: ", "must not contain"}, [&] { list("left/right"); });
  check_true("closest", closest("quadratc", {"cubic", "quadratic"}) == "quadratic");
  check_true("closest of none", closest("xyz", {"cubic", "quadratic"}).empty());
}
