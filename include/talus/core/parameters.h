#pragma once

#include <talus/core/exceptions.h>
#include <talus/core/registry.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Talus
{
  /** A section and an entry as one key without a leading slash. */
  std::string parameter_key(const std::string &section, const std::string &entry);

  /**
   * A parameter file and the `--set` overrides, read in two passes.
   *
   * Constructing scans the text: every entry's value and where it was set.
   * While objects are built they ask `choose()` and `names()` what to build
   * next. Each object is a dealii::ParameterAcceptor, so when all of them exist
   * the handler knows every entry that may be set, and `parse()` checks the file
   * against it strictly. Errors name file, line, entry and remedy.
   */
  class Parameters
  {
  public:
    struct Setting
    {
      std::string value;
      std::string origin; // "file.prm:12" or "--set"
    };

    /** Reads `file_name`; `overrides` are "Section/Entry = value". Throws InputError. */
    Parameters(const std::string &file_name, const std::vector<std::string> &overrides = {});

    /** The same for a text in memory that is called `name`. */
    static Parameters from_text(const std::string &text, const std::string &name = "text",
                                const std::vector<std::string> &overrides = {});

    /** What the file and `--set` set, with all stages, as the text of a file without `include`. */
    std::string settings_text() const;

    /** Declares a choice among what is registered in a kind and returns what the file chooses. */
    template <class Interface>
    std::string choose(const std::string &section, const std::string &entry, const std::string &default_value,
                       const std::string &help);

    /** The same among the names in `selection` ("a|b|c"). */
    std::string choose_from(const std::string &section, const std::string &entry, const std::string &default_value,
                            const std::string &selection, const std::string &help);

    /** Builds the object that the file chooses; it reads `object_section`. */
    template <class Interface>
    std::unique_ptr<Interface> make(const std::string &section, const std::string &entry,
                                    const std::string &default_value, const std::string &help);

    /** Declares and returns the list of names of the objects in a section ("Bodies", ...). */
    std::vector<std::string> names(const std::string &section, const std::string &help);

    /**
     * What the file says from a stage on: the entries within the subsections of "Stages/NAME" of the first `n` names
     * take the place of those of the run, each stage after the one before. Objects that only another stage lists are
     * left out. No object may exist.
     */
    Parameters after_changes(const std::vector<std::string> &stages, const unsigned int n) const;

    /** Sets an entry as if the file had; `origin` says in messages where. No object may exist. */
    void set(const std::string &section, const std::string &entry, const std::string &value, const std::string &origin)
    {
      settings[parameter_key(section, entry)] = {value, origin};
    }

    /** The entries that a stage changes: "Materials/sand/Cohesion". */
    std::vector<std::string> changed_by(const std::string &stage) const;

    /** Whether the file, or `--set`, sets an entry. */
    bool is_set(const std::string &section, const std::string &entry) const { return find(section, entry) != nullptr; }

    /** What the file sets an entry to, or `default_value`; nothing is declared. */
    std::string value(const std::string &section, const std::string &entry, const std::string &default_value) const
    {
      const Setting *setting = find(section, entry);
      return setting == nullptr ? default_value : setting->value;
    }

    /** Whether the file sets anything in a section or in those within. */
    bool has_section(const std::string &section) const;

    /**
     * Lets an entry of an object that is switched off stand in the file, where nothing reads it. A `reason` becomes a
     * warning that it has no effect, if it is set.
     */
    void allow(const std::string &section, const std::string &entry, const std::string &reason = "");

    /** Throws the error if the file sets its entry. */
    void refuse(const EntryError &error) const
    {
      if (is_set(error.section, error.entry))
        throw EntryError(error);
    }

    /** Keeps what the user should be told, with the place where the entry was set. */
    void warn(const EntryError &error) { notes.push_back(locate(error)); }

    /** All that warn() has got, in this order. */
    const std::vector<std::string> &warnings() const { return notes; }

    /**
     * The entries, by "Section/Entry", that objects declare which `build` makes and drops. Before any object of the run
     * is made.
     */
    static std::vector<std::string> declared_by(const std::function<void()> &build);

    /** Checks every entry against what the objects declared, and sets their members. */
    void parse();

    /** The first half of it: checks them, so that print() has them. */
    void enter_values();

    /** The message of an error, with the place where its entry was set. */
    std::string locate(const EntryError &error) const;

    /** All entries of the chosen objects, with or without their help. */
    void print(std::ostream &out, const bool with_help) const;

  private:
    Parameters() = default;
    void              scan(std::istream &in, const std::string &file_name, std::vector<std::string> &path);
    void              add_override(const std::string &text);
    [[noreturn]] void reject_unknown(const std::string &key, const Setting &setting) const;
    const Setting    *find(const std::string &section, const std::string &entry) const;

    /** Whether an entry is of an object that the file lists, and `--set` or the stage does not. */
    bool is_left_out(const std::string &key) const;

    std::map<std::string, Setting>     settings;    // by "Section/Subsection/Entry"
    std::map<std::string, std::string> sections;    // where each was opened
    std::vector<std::string>           open_files;  // being scanned, each included by the one before
    std::map<std::string, std::string> other_names; // of objects that `--set` or a stage has left out, by section
    std::set<std::string>              of_others;   // entries of objects that a stage has put others in place of
    std::map<std::string, std::string> idle;        // entries that nothing reads, and why that may surprise
    std::vector<std::string>           notes;
    std::string                        file_name;
    std::string                        text_of_all; // settings_text() of all stages, in those of one
  };

  /** Among `candidates` the one most like `word`; empty when none is close. */
  std::string closest(const std::string &word, const std::vector<std::string> &candidates);

  template <class Interface>
  std::string Parameters::choose(const std::string &section, const std::string &entry, const std::string &default_value,
                                 const std::string &help)
  {
    return choose_from(section, entry, default_value, Registry<Interface>::get().selection(), help);
  }

  template <class Interface>
  std::unique_ptr<Interface> Parameters::make(const std::string &section, const std::string &entry,
                                              const std::string &default_value, const std::string &help)
  {
    return Registry<Interface>::get().make(choose<Interface>(section, entry, default_value, help), *this, section);
  }
} // namespace Talus
