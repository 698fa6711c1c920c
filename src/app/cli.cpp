#include "app/cli.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/check/check.hpp"
#include "app/load_extension.hpp"
#include "app/manual.hpp"
#include "app/python_program.hpp"
#include "app/run_deck.hpp"
#include "app/terminal.hpp"
#include "base/version.hpp"
#include "keyword/help/keyword_state.hpp"
#include "keyword/read/cases.hpp"
#include "keyword/registry.hpp"
#include "output/file.hpp"
#include "parallel/parallel.hpp"

namespace courant {

namespace {

std::atomic<bool> stop_requested{false};
void request_stop(int) {
  stop_requested = true;
}

struct Call {
  std::vector<Id> only_cases;
  std::optional<LoadCase> one_case;  ///< of the deck, that this call is for
  std::string deck, dir = ".", keyword, restart;
  std::vector<std::string> params, loads, texts;
  int threads = 0;
  Real until = 0;
  bool d3plot = false;
  bool no_final_dump = false, quiet = false, markdown = false, cannot_do = false, strict = false,
       json = false;
};

/// Words of calls that the Python package answers, which are looked at here alone for mistakes.
struct PythonCall {
  std::string input, dir, compare, page, field;
  std::vector<std::string> only, loads, params;
  int jobs = 0, state = -1;
  Real at = 0;
  bool fresh = false;
};

void print_error(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

/// Splits NAME=VALUE; a wrong one is an input error.
bool parse_pairs(const char* option, const char* form, const std::vector<std::string>& words,
                 std::map<std::string, std::string>& out) {
  for (const std::string& word : words) {
    const auto at = word.find('=');
    if (at == std::string::npos || at == 0) {
      print_error(fmt::format("error: {} expects {}, got '{}'\n", option, form, word));
      return false;
    }
    out[word.substr(0, at)] = word.substr(at + 1);
  }
  return true;
}

std::filesystem::path whole_path(const std::string& file) {
  std::error_code unreadable;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file, unreadable), unreadable);
}

/// Files that are read instead of others: FILE=TEXT.
bool add_texts(const std::vector<std::string>& words, ReadOptions& out) {
  std::map<std::string, std::string> texts;
  if (!words.empty() && !parse_pairs("--text", "FILE=TEXT", words, texts)) return false;
  if (texts.empty()) return true;
  std::map<std::filesystem::path, std::string> instead;
  for (const auto& [file, text] : texts) instead[whole_path(file)] = text;
  out.open = [instead](const std::string& path) {
    const auto found = instead.find(whole_path(path));
    return text_of_file(found == instead.end() ? path : found->second);
  };
  return true;
}

/// How the deck of a call is read; false where its words are wrong.
bool read_options(const Call& call, ReadOptions& out) {
  if (!parse_pairs("--param", "NAME=VALUE", call.params, out.parameters)) return false;
  if (call.d3plot) out.more = "*COURANT_D3PLOT\n1\n";
  if (!add_texts(call.texts, out)) return false;
  if (call.one_case)
    out.open = [subcases = call.one_case->subcases](const std::string& path) -> std::optional<std::string> {
      const auto text = text_of_file(path);
      return text ? std::optional(text_of_case(*text, subcases)) : std::nullopt;
    };
  return true;
}

/// From here on signals end a run cleanly.
void catch_signals() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  if (std::signal(SIGHUP, request_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // as nohup wants it
  // A limit on file sizes is then a failed write, with a message and a summary. Ctrl-C also ends the `tee`
  // that reads from here: the run still has its files to write.
  for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
}

int call_run(const Call& call) {
  RunCall run;
  run.deck = call.deck, run.restart = call.restart, run.threads = call.threads;
  if (!read_options(call, run.read)) return exit_input;
  run.messages = [](const Diagnostics& diagnostics) { print_error(diagnostics.text()); };
  run.before_run = catch_signals;
  RunOptions& options = run.options;
  options.dir = call.dir, options.until = call.until, options.d3plot = call.d3plot;
  options.params = call.params, options.stop = &stop_requested, options.dump_at_end = !call.no_final_dump;
  if (call.one_case) options.load_case = call.one_case->id;
  if (!call.quiet) {
    options.print = print_line;
    options.progress = status_line();
    if (!options.progress) options.progress = progress_lines();
    options.keyboard = keyboard_is_terminal();
  }
  const RunResult result = run_deck(run);
  const bool ended = !result.summary.termination.empty() && result.summary.termination != "error";
  if (ended && !call.quiet) print_text(fmt::format("results are in {}\n", call.dir));
  print_error(result.error);
  return result.exit_code;
}

int call_check(const Call& call) {
  set_threads(1);
  ReadOptions read;
  if (!read_options(call, read)) return exit_input;
  const CheckResult result = check_deck(call.deck, read, call.strict);
  if (call.json) {
    print_text(result.json);
    return result.sound ? exit_ok : exit_input;
  }
  // on a terminal: what was read, what is wrong with it, what a run would compute, the sum
  fmt::print("{}", result.deck);
  std::fflush(stdout);
  print_error(result.messages);
  fmt::print("{}", result.model);
  std::fflush(stdout);
  if (result.sound)
    fmt::print("{}", result.verdict);
  else
    print_error(result.verdict);
  return result.sound ? exit_ok : exit_input;
}

/// Calls of(call) for each case that a deck has and the call asks for, or once for a deck without cases.
/// Returns the largest exit code; ends behind a case that was stopped.
int for_cases(Call call, bool alone, const std::function<int(const Call&)>& of) {
  auto text = text_of_file(call.deck);
  if (!text || !has_cases(*text)) {
    text.reset();  // may be large, and the call is long
    if (call.only_cases.empty()) return of(call);
    print_error("error: --case: the deck has no *CASE\n");
    return exit_input;
  }
  Diagnostics diagnostics;
  std::vector<LoadCase> cases = cases_in(call.deck, *text, diagnostics);
  print_error(diagnostics.text());
  if (!diagnostics.ok()) return exit_input;
  for (const Id wanted : call.only_cases)
    if (std::none_of(cases.begin(), cases.end(), [&](const LoadCase& c) { return c.id == wanted; })) {
      print_error(fmt::format("error: --case {}: the deck has no such case\n", wanted));
      return exit_input;
    }
  if (!call.only_cases.empty())
    std::erase_if(cases, [&](const LoadCase& c) {
      return std::find(call.only_cases.begin(), call.only_cases.end(), c.id) == call.only_cases.end();
    });
  if (alone && cases.size() > 1) {
    print_error("error: the deck has several cases\n  hint: choose one with --case ID\n");
    return exit_input;
  }
  int worst = exit_ok;
  for (const LoadCase& one : cases) {
    Call own = call;
    own.one_case = one;
    if (call.restart.empty()) own.dir = (std::filesystem::path(call.dir) / one.job).string();
    if (!call.quiet && !call.json) print_text(fmt::format("case {}: {}\n", one.id, one.job));
    worst = std::max(worst, of(own));
    if (stop_requested) break;
  }
  return worst;
}

int call_keywords(const Call& call) {
  if (call.json) {
    print_text(keyword_json());
    return exit_ok;
  }
  if (call.markdown) {
    fmt::print("{}", keyword_markdown());
    return exit_ok;
  }
  if (call.cannot_do) {
    fmt::print("{}", cannot_do_markdown());
    return exit_ok;
  }
  const KeywordAnswer answer = find_keywords(call.keyword);
  if (!answer.found) {
    print_error(fmt::format("error: {}\n{}", answer.text,
                            answer.hint.empty() ? "" : fmt::format("  hint: {}\n", answer.hint)));
    return exit_input;
  }
  fmt::print("{}", answer.text);
  return exit_ok;
}

/// A scene is written as a deck first, by the Python package. A deck may have any name.
bool is_scene(const std::string& file) {
  if (!file.ends_with(".yaml") && !file.ends_with(".yml")) return false;
  const int first = std::ifstream(file).get();
  return first != '*' && first != '$';
}

int call_manual(const CLI::App& app, const std::string& folder) {
  try {
    write_manual(app, folder);
    return exit_ok;
  } catch (const OutputError& error) {
    print_error(fmt::format("error: {}\n", error.what()));
    return exit_input;
  }
}

/// LS-DYNA users type `i=DECK ncpu=N r=FILE`: rewritten to our options before they are read.
std::vector<std::string> translate_habits(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::vector<std::string> out;
  bool habit = false;
  for (const std::string& word : words) {
    if (!out.empty() && out.back() == "--param") {  // `--param i=5` is a parameter named i
      out.push_back(word);
    } else if (word.rfind("i=", 0) == 0) {
      habit = true;
      out.push_back(word.substr(2));
    } else if (word.rfind("r=", 0) == 0) {
      out.push_back("--restart");
      out.push_back(word.substr(2));
    } else if (word.rfind("ncpu=", 0) == 0) {
      out.push_back("--threads");
      out.push_back(
          word.substr(word.rfind("ncpu=-", 0) == 0 ? 6 : 5));  // LS-DYNA's sign means another order of sums
    } else if (word.rfind("memory=", 0) != 0) {
      out.push_back(word);
    }
  }
  if (habit && (out.empty() || out.front() != "run")) out.insert(out.begin(), "run");
  return out;
}

}  // namespace

int command_line(int argc, char** argv) {
  CLI::App app{"Courant: explicit multiphysics solver for LS-DYNA-style keyword decks", "courant"};
  app.set_version_flag("--version", std::string("courant " COURANT_VERSION "\n" COURANT_BUILD));
  app.require_subcommand(1);
  app.footer(
      "\n`courant check DECK.k` reports on a deck, `courant run DECK.k -o DIR` computes it,\n"
      "`courant help run` has the options of a call. Exit codes: 0 done, 1 the input is wrong, 2 the run\n"
      "ended in error or its results cannot be trusted, 3 anything else.");
  Call call;

  auto* run_ = app.add_subcommand("run", "run a deck (also: courant i=DECK ncpu=N)");
  run_->add_option("DECK", call.deck, "keyword deck, or scene.yaml")->required();
  run_->add_option("-o,--output", call.dir, "folder for the results; made if missing");
  run_->add_option("--threads", call.threads, "threads; 0: as many as are quickest")
      ->check(CLI::NonNegativeNumber);
  run_->add_option("--until", call.until, "end time instead of ENDTIM")->check(CLI::PositiveNumber);
  run_->add_option("--param", call.params, "NAME=VALUE: override a *PARAMETER, or one of the scene")
      ->allow_extra_args(false);
  const auto add_load = [&](CLI::App* to) {
    to->add_option("--load", call.loads, "FILE.so with laws, loads, elements of your own")
        ->allow_extra_args(false);
  };
  const auto add_case = [&](CLI::App* to) {
    to->add_option("--case", call.only_cases, "ID[,ID...]: these cases of a deck with *CASE alone")
        ->delimiter(',')
        ->allow_extra_args(false);
  };
  add_case(run_);
  add_load(run_);
  run_->add_option("--restart", call.restart,
                   "go on from this restart file, or from the latest in this folder of results");
  run_->add_flag("--no-final-dump", call.no_final_dump, "write no restart file at the end or when stopped");
  run_->add_flag("--d3plot", call.d3plot, "write states as d3plot, too, as *COURANT_D3PLOT does");
  run_->add_flag("--quiet", call.quiet, "print errors only");

  auto* check = app.add_subcommand("check", "read, validate and build a deck; run nothing");
  check->add_option("DECK", call.deck, "keyword deck, or scene.yaml")->required();
  check->add_option("--param", call.params, "NAME=VALUE: override a *PARAMETER")->allow_extra_args(false);
  add_case(check);
  add_load(check);
  check->add_flag("--strict", call.strict, "warnings, and ids that nothing refers to, are errors");
  check
      ->add_option("--text", call.texts, "FILE=TEXT: reads the file TEXT instead of FILE, as editors need it")
      ->allow_extra_args(false);
  check->add_flag("--json", call.json, "the report and its messages for programs, on standard output");

  auto* keywords = app.add_subcommand("keywords", "list the supported keywords, or show the cards of one");
  keywords->add_option("NAME", call.keyword, "keyword, with or without '*'");
  add_load(keywords);
  keywords->add_flag("--markdown", call.markdown, "all cards as docs/keywords.md");
  keywords->add_flag("--json", call.json, "all cards for programs");
  keywords->add_flag("--cannot-do", call.cannot_do, "all that is refused, as docs/cannot_do.md");

  PythonCall python;  // what these do, the package in src/python does
  auto* generate = app.add_subcommand("generate", "write a keyword deck from a YAML scene");
  generate->add_option("SCENE", python.input, "scene.yaml")->required();
  generate->add_option("-o,--output", python.page, "deck to write")->required();
  generate->add_option("--param", python.params, "NAME=VALUE: a parameter of the scene")
      ->allow_extra_args(false);
  const auto add_python_load = [&](CLI::App* to) {
    to->add_option("--load", python.loads, "FILE.py with analyses, observations, charts of your own")
        ->allow_extra_args(false);
  };
  auto* post = app.add_subcommand("post", "tables, CSV and pictures from the results of a run");
  std::vector<std::string> places;
  post->add_option("RECIPE", places,
                   "recipe.yaml, and the folder of the run; the folder alone: a report, or the view")
      ->type_name("DIR")
      ->expected(1, 2)
      ->required();
  post->add_option("--view", python.page,
                   "FIELD: a picture of the last state by it, with or without a recipe");
  post->add_option("--threads", python.jobs, "processes; 0: all cores")->check(CLI::NonNegativeNumber);
  add_python_load(post);

  auto* report = app.add_subcommand("report", "one HTML page on a run, or on two side by side");
  report->add_option("DIR", places, "folder of the run, or of two")->expected(1, 2)->required();
  report->add_option("-o,--output", python.dir, "FILE: the page; DIR/report.html if not given");

  auto* view =
      app.add_subcommand("view", "a state of a run, or the first of a deck, in a window or a picture");
  view->add_option("DIR", python.input, "folder of the run, keyword deck, or scene.yaml")->required();
  view->add_option("-o,--output", python.dir, "FILE: a picture instead of a window: PNG, PDF, SVG");
  view->add_option("--state", python.state, "number of the state, from 0; -1, the last, if not given");
  view->add_option("--at", python.at, "the state nearest to this time");
  view->add_option("--field", python.field, "what colours it; speed if not given");

  auto* verify = app.add_subcommand("verify", "run a suite of cases: errors against run time, and stability");
  verify->add_option("SUITE", python.input, "suite.yaml")->required();
  verify->add_option("-o,--output", python.dir, "folder for runs and results; SUITE_verify if not given");
  verify->add_option("--jobs", python.jobs, "runs at once; 0: one per core")->check(CLI::NonNegativeNumber);
  verify->add_option("--only", python.only, "CASE[,CASE...]: these cases alone")
      ->delimiter(',')
      ->allow_extra_args(false);
  verify->add_option("--compare", python.compare, "results.csv of an earlier call: report what got worse");
  verify->add_option("--page", python.page,
                     "also write a Markdown page with its charts in a folder beside it");
  verify->add_flag("--fresh", python.fresh, "take over no runs of an earlier call");
  add_python_load(verify);

  auto* schema = app.add_subcommand("schema", "JSON schema of scenes, recipes or suites, for editors");
  schema->add_option("KIND", python.input, "scene, recipe or suite")->required();
  schema->add_option("-o,--output", python.page, "FILE: the schema; on standard output if not given");

  auto* lsp = app.add_subcommand("lsp", "language server for keyword decks, on standard input and output");
  lsp->add_flag("--stdio", python.fresh, "the default; editors add it");

  auto* help = app.add_subcommand("help", "show help for a call");
  std::string topic;
  help->add_option("CALL", topic, "run, check, keywords, generate, post, report, verify, schema or lsp");

  auto* manual = app.add_subcommand("manual", "write pages of the manual, and completion for bash");
  manual->group("")->add_option("DIR", call.dir, "folder for them")->required();  // called by the build

  std::vector<std::string> words = translate_habits(argc, argv);
  if (words.empty()) {
    print_error(app.help());
    return exit_input;
  }
  std::vector<std::string> calls;
  for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
    calls.push_back(one->get_name());
  if (!words.empty() && words[0][0] != '-' &&
      std::find(calls.begin(), calls.end(), words[0]) == calls.end()) {
    const std::string near = nearest_word(words[0], calls);
    print_error(fmt::format("error: '{}' is no call of courant\n  hint: {}\n", words[0],
                            near.empty() ? fmt::format("the calls are {}", fmt::join(calls, ", "))
                                         : fmt::format("did you mean `courant {}`?", near)));
    return exit_input;
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    const auto called = app.get_subcommands();
    const std::string mistyped = unknown_options(called.empty() ? app : *called.front(), words);
    if (error.get_exit_code() != 0 && !mistyped.empty()) {
      print_error(mistyped);
      return exit_input;
    }
    return app.exit(error) == 0 ? exit_ok : exit_input;
  }
  for (const std::string& file : call.loads)
    if (const std::string why = load_extension(file); !why.empty()) {
      print_error(fmt::format("error: --load: {}\n", why));
      return exit_input;
    }
  const bool of_scene = (*run_ || *check) && is_scene(call.deck);
  if (*generate || *post || *report || *verify || *view || *schema || *lsp || of_scene) {
    print_error(fmt::format("error: {}\n", become_python_program(words)));
    return exit_other;
  }
  if (*run_) return for_cases(call, !call.restart.empty(), call_run);
  if (*check) return for_cases(call, call.json, call_check);
  if (*keywords) return call_keywords(call);
  if (*manual) return call_manual(app, call.dir);
  const auto found = app.get_subcommands([&](const CLI::App* one) { return one->get_name() == topic; });
  fmt::print("{}", (found.empty() ? &app : found.front())->help());
  return topic.empty() || !found.empty() ? exit_ok : exit_input;
}

}  // namespace courant
