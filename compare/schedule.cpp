#include "compare/schedule.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "compare/statistics.h"

namespace halfspace::compare {
namespace {

using Kind = TraceEvent::Kind;

class Simulation {
 public:
  Simulation(int cores, double wake_us) : helpers_(static_cast<size_t>(cores - 1)), wake_(wake_us) {}

  void take(const TraceEvent& event) {
    switch (event.kind) {
      case Kind::serial:
        now_ += event.tasks_us.at(0);
        break;
      case Kind::front:
        run_front(event.tasks_us);
        break;
      case Kind::prepare:
        prepare_ = event.tasks_us.at(0);
        break;
      case Kind::back:
        back_ = event.tasks_us;
        next_ = 0;
        prepared_ = now_;
        back_open_ = now_ + wake_;
        back_end_ = now_;
        break;
      case Kind::wait:
        finish_back();
        break;
      case Kind::picture:
        pictures_.push_back(now_);
        break;
    }
  }

  // Times between pictures.
  std::vector<double> frames() const {
    std::vector<double> frames;
    for (size_t i = 1; i < pictures_.size(); ++i) frames.push_back(pictures_[i] - pictures_[i - 1]);
    return frames;
  }

 private:
  double& earliest_helper() { return *std::min_element(helpers_.begin(), helpers_.end()); }

  // Helpers take tasks of the back as long as they begin before `time`.
  void advance_helpers(double time) {
    if (prepare_ > 0 && !helpers_.empty()) {
      double& helper = earliest_helper();
      const double start = std::max(helper, back_open_);
      if (start >= time) return;
      prepared_ = back_open_ = helper = start + std::exchange(prepare_, 0);
    }
    while (next_ < back_.size() && !helpers_.empty()) {
      double& helper = earliest_helper();
      const double start = std::max(helper, back_open_);
      if (start >= time) return;
      helper = start + back_[next_++];
      back_end_ = std::max(back_end_, helper);
    }
  }

  void run_front(const std::vector<double>& tasks) {
    advance_helpers(now_);
    const double open = now_ + wake_;
    double own = now_, end = now_;
    for (const double task : tasks) {
      double* helper = helpers_.empty() ? nullptr : &earliest_helper();
      const bool helped = helper != nullptr && std::max(*helper, open) < own;
      double& worker = helped ? *helper : own;
      worker = (helped ? std::max(*helper, open) : own) + task;
      end = std::max(end, worker);
    }
    now_ = end;
  }

  void finish_back() {
    advance_helpers(now_);
    if (prepare_ > 0) prepared_ = back_open_ = now_ + std::exchange(prepare_, 0);  // nobody else had the time
    now_ = std::max(now_, prepared_);
    advance_helpers(now_);
    while (next_ < back_.size()) {
      now_ += back_[next_++];
      advance_helpers(now_);
    }
    now_ = std::max(now_, back_end_);
    back_.clear();
    next_ = 0;
  }

  std::vector<double> helpers_;  // when each is free
  double wake_;
  double now_ = 0;  // of the caller
  std::vector<double> back_;
  size_t next_ = 0;
  double prepare_ = 0;   // what has to be done before the back's first task
  double prepared_ = 0;  // when that is done
  double back_open_ = 0, back_end_ = 0;
  std::vector<double> pictures_;
};

struct Work {
  double all = 0, serial = 0;
};

// Between the first picture and the last.
Work work_of(const Trace& trace) {
  Work work;
  Work at_last;
  bool begun = false;
  for (const TraceEvent& event : trace.events) {
    if (event.kind == Kind::picture) {
      if (begun) at_last = work;
      begun = true;
    }
    if (!begun) continue;
    for (const double task : event.tasks_us) {
      work.all += task;
      if (event.kind == Kind::serial) work.serial += task;
    }
  }
  return at_last;
}

TraceEvent event_of(const std::string& line) {
  static const std::map<std::string, Kind> kinds{{"serial", Kind::serial},   {"front", Kind::front},
                                                 {"prepare", Kind::prepare}, {"back", Kind::back},
                                                 {"wait", Kind::wait},       {"picture", Kind::picture}};
  std::istringstream words(line);
  std::string name;
  words >> name;
  const auto kind = kinds.find(name);
  if (kind == kinds.end()) throw std::runtime_error("not a line of a trace: " + line.substr(0, 80));
  TraceEvent event{kind->second, {}};
  for (double nanoseconds = 0; words >> nanoseconds;) event.tasks_us.push_back(nanoseconds * 1e-3);
  const bool is_one = event.kind == Kind::serial || event.kind == Kind::prepare;
  if (!words.eof() || (is_one && event.tasks_us.size() != 1))
    throw std::runtime_error("not a line of a trace: " + line.substr(0, 80));
  return event;
}

}  // namespace

Trace read_trace(std::istream& in) {
  Trace trace, last;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("pool ")) {
      if (!trace.events.empty()) last = std::move(trace);
      trace = {std::stoi(line.substr(5)), {}};
    } else {
      trace.events.push_back(event_of(line));
    }
  }
  return trace.events.empty() ? last : trace;
}

Schedule simulate(const Trace& trace, int cores, double wake_us) {
  Simulation simulation(cores, wake_us);
  for (const TraceEvent& event : trace.events) simulation.take(event);
  const std::vector<double> frames = simulation.frames();
  if (frames.empty()) throw std::runtime_error("a trace of two pictures at least is needed");
  const Work work = work_of(trace);
  return {summarize(frames).median * 1e-3, work.all * 1e-3 / static_cast<double>(frames.size()),
          work.all > 0 ? work.serial / work.all : 0};
}

}  // namespace halfspace::compare
