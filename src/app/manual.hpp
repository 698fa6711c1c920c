#pragma once
// What is made of the program's own description of its calls: pages of the manual, completion for bash, and
// hints where an option is mistyped. So none of them can report options that are not there.
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace courant {

/// Options of a call as they are typed: "--output", "-o".
std::vector<std::string> option_names(const CLI::App& call);

/// Of the words of a call those that are meant as options and are none, with the nearest that is; empty:
/// none.
std::string unknown_options(const CLI::App& call, const std::vector<std::string>& words);

/// Page of section 1 of the manual, of one call or, for `app` itself, of the program.
std::string manual_page(const CLI::App& app, const CLI::App& call);

/// Completion of calls, options, files and names of keywords.
std::string bash_completion(const CLI::App& app);

/// Writes them all into a folder, which is made if missing. Throws OutputError.
void write_manual(const CLI::App& app, const std::string& folder);

}  // namespace courant
