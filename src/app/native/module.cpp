// The extension module of the Python package: runs in the process of the caller.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <csignal>
#include <memory>
#include <optional>

#include "app/native/live_state.hpp"
#include "app/run_deck.hpp"
#include "keyword/read/cases.hpp"

namespace py = pybind11;

namespace courant::native {

namespace {

struct Stop {
  std::atomic<bool> asked{false};
};

std::atomic<std::atomic<bool>*> stop_of_signal{nullptr};
void ask_for_stop(int) {
  if (std::atomic<bool>* stop = stop_of_signal.load()) *stop = true;
}

/// Ctrl-C ends a run as on the terminal, except while Python code is called, which gets it itself.
class Interrupts {
 public:
  explicit Interrupts(std::atomic<bool>* stop) : wanted_(stop != nullptr) {
    if (!wanted_) return;
    stop_of_signal = stop;
    struct sigaction mine {};
    mine.sa_handler = ask_for_stop;
    ::sigaction(SIGINT, &mine, &of_python_);
  }
  ~Interrupts() {
    if (!wanted_) return;
    ::sigaction(SIGINT, &of_python_, nullptr);
    stop_of_signal = nullptr;
  }
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;
  template <class Work>
  auto of_python(const Work& work) const {
    struct sigaction mine {};
    if (wanted_) ::sigaction(SIGINT, &of_python_, &mine);
    const std::unique_ptr<const struct sigaction, void (*)(const struct sigaction*)> back(
        wanted_ ? &mine : nullptr, [](const struct sigaction* it) { ::sigaction(SIGINT, it, nullptr); });
    return work();
  }

 private:
  bool wanted_;
  struct sigaction of_python_ {};
};

/// Calls of Python from the run. The first exception ends the run, and is raised at its end.
class Caller {
 public:
  Caller(Stop& stop, const Interrupts& interrupts) : stop_(stop), interrupts_(interrupts) {}
  ~Caller() {  // an exception that nothing raised
    const py::gil_scoped_acquire python;
    fault_.reset();
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;
  template <class Work>
  bool operator()(const Work& work) {
    const py::gil_scoped_acquire python;
    if (fault_) return false;
    try {
      interrupts_.of_python(work);
    } catch (py::error_already_set& fault) {
      fault_.emplace(fault);
    }
    return !fault_;
  }
  void text(const py::object& function, const std::string& line) {
    if (!(*this)([&] { function(line); })) stop_.asked = true;
  }
  void raise() {
    if (!fault_) return;
    py::error_already_set fault = *fault_;
    throw fault;
  }

 private:
  Stop& stop_;
  const Interrupts& interrupts_;
  std::optional<py::error_already_set> fault_;
};

struct Messages {
  using One = std::tuple<std::string, std::string, int, int, std::string, std::string, std::string>;
  std::vector<One> all;
  void take(const Diagnostics& diagnostics) {
    for (const Diagnostic& d : diagnostics.all()) {
      const char* const severity = d.severity == Severity::error     ? "error"
                                   : d.severity == Severity::warning ? "warning"
                                                                     : "note";
      all.emplace_back(severity, d.where.file, d.where.line, d.where.column, d.message, d.hint,
                       d.where.included_from);
    }
  }
};

std::atomic_flag busy = ATOMIC_FLAG_INIT;
struct Busy {
  Busy() {
    if (busy.test_and_set())
      throw std::runtime_error("another run goes on in this process: wait for its end");
  }
  ~Busy() { busy.clear(); }
};

struct Options {
  std::string deck, folder, restart;
  double until = 0;
  int threads = 0;
  std::vector<std::string> words;  ///< NAME=VALUE
  std::map<std::string, std::string> parameters;
  std::int64_t every_steps = 0;
  double every_time = 0;
  bool interrupts = false;
};

std::tuple<int, std::string, std::vector<Messages::One>> run(const Options& options, Stop& stop,
                                                             const py::object& messages,
                                                             const py::object& print,
                                                             const py::object& progress,
                                                             const py::object& callback) {
  const Busy only_one;
  RunCall call;
  Messages found;
  call.deck = options.deck, call.restart = options.restart, call.threads = options.threads;
  call.read.parameters = options.parameters;
  call.options.dir = options.folder, call.options.until = options.until, call.options.params = options.words;
  call.options.stop = &stop.asked;
  const Interrupts interrupts(options.interrupts ? &stop.asked : nullptr);
  Caller caller(stop, interrupts);
  call.messages = [&](const Diagnostics& diagnostics) {
    found.take(diagnostics);
    if (!messages.is_none()) caller.text(messages, diagnostics.text());
  };
  if (!print.is_none()) call.options.print = [&](const std::string& line) { caller.text(print, line); };
  if (!progress.is_none())
    call.options.progress = [&](const std::string& line) { caller.text(progress, line); };
  if (!callback.is_none()) {
    call.read.more = "*COURANT_PROGRAM_FORCES\n1\n";
    call.options.hook = {.call =
                             [&](Simulation& simulation) {
                               return caller([&] {
                                 const auto state = std::make_shared<LiveState>(simulation);
                                 const struct End {
                                   LiveState& of;
                                   ~End() { of.end(); }
                                 } end{*state};
                                 callback(state);
                               });
                             },
                         .every_steps = options.every_steps,
                         .every_time = options.every_time};
  }
  RunResult result;
  {
    const py::gil_scoped_release others;
    result = run_deck(call);
  }
  caller.raise();
  return {result.exit_code, result.error, found.all};
}

bool deck_has_cases(const std::string& deck) {
  const auto text = text_of_file(deck);
  return text && has_cases(*text);
}

}  // namespace

}  // namespace courant::native

PYBIND11_MODULE(_courant, module) {
  using namespace courant;
  using namespace courant::native;
  py::class_<Stop>(module, "Stop").def(py::init<>()).def("ask", [](Stop& stop) { stop.asked = true; });
  py::class_<Options>(module, "Options")
      .def(py::init<>())
      .def_readwrite("deck", &Options::deck)
      .def_readwrite("folder", &Options::folder)
      .def_readwrite("restart", &Options::restart)
      .def_readwrite("until", &Options::until)
      .def_readwrite("threads", &Options::threads)
      .def_readwrite("words", &Options::words)
      .def_readwrite("parameters", &Options::parameters)
      .def_readwrite("every_steps", &Options::every_steps)
      .def_readwrite("every_time", &Options::every_time)
      .def_readwrite("interrupts", &Options::interrupts);
  py::class_<RigidBodyReport>(module, "Body")
      .def_readonly("part", &RigidBodyReport::part)
      .def_readonly("mass", &RigidBodyReport::mass)
      .def_readonly("x", &RigidBodyReport::x)
      .def_readonly("v", &RigidBodyReport::v)
      .def_readonly("omega", &RigidBodyReport::omega)
      .def_readonly("force", &RigidBodyReport::force)
      .def_readonly("moment", &RigidBodyReport::moment)
      .def_readonly("kinetic_energy", &RigidBodyReport::kinetic_energy);
  py::class_<LiveState, std::shared_ptr<LiveState>>(module, "State")
      .def_readonly("t", &LiveState::t)
      .def_readonly("dt", &LiveState::dt)
      .def_readonly("cycle", &LiveState::cycle)
      .def_property_readonly("dim", &LiveState::dim)
      .def("units", &LiveState::units)
      .def("sets", &LiveState::sets)
      .def("size", &LiveState::size)
      .def("active", &LiveState::active)
      .def("fields", &LiveState::fields)
      .def("array", &LiveState::array)
      .def("bodies", &LiveState::bodies)
      .def("set_forces", &LiveState::set_forces)
      .def("set_velocities", &LiveState::set_velocities)
      .def("push_body", &LiveState::push_body)
      .def("move_body", &LiveState::move_body);
  module.def("run", &native::run);
  module.def("has_cases", &deck_has_cases);
}
