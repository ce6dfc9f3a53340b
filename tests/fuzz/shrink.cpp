#include "shrink.h"

#include <algorithm>

namespace halfspace::fuzz {
namespace {

using Units = std::vector<Stream>;

// What stays together: something flat with its colours, because without a corner it is flat no more and GL
// leaves open how it is cut; edge flags with their end; arrays and maps with what is drawn from them, the
// raster position with what it is for.
size_t unit_end(const Stream& stream, size_t at) {
  const auto find_end = [&](auto is_end, size_t after = 0) {
    size_t end = at + after;
    while (end < stream.size() && !is_end(stream[end].command)) ++end;
    return std::min(end + 1, stream.size());
  };
  if (stream[at].command == Command::glVertexPointer) {
    return find_end([](Command command) {
      return command == Command::glDrawArrays || command == Command::glDrawElements ||
             command == Command::glEnd;
    });
  }
  if (stream[at].command == Command::glMap1f || stream[at].command == Command::glMap2f) {
    return find_end([](Command command) { return command == Command::glNormal3f; });
  }
  if (stream[at].command == Command::glMatrixMode && stream[at].arguments[0] != GL_MODELVIEW)
    return find_end([](Command command) { return command == Command::glMatrixMode; }, 1);
  if (stream[at] == Call{Command::glDisable, {GL_LIGHTING}, {}}) {
    return find_end([](Command command) {
      return command == Command::glDrawPixels || command == Command::glBitmap ||
             command == Command::glCopyPixels;
    });
  }
  if (stream[at].command != Command::glBegin) return at + 1;
  const size_t end = find_end([](Command command) { return command == Command::glEnd; });
  const bool flags = std::any_of(stream.begin() + static_cast<std::ptrdiff_t>(at),
                                 stream.begin() + static_cast<std::ptrdiff_t>(end),
                                 [](const Call& call) { return call.command == Command::glEdgeFlag; });
  return stream[at].arguments[0] >= GL_QUADS || flags ? end : at + 1;
}

Units split(const Stream& stream) {
  Units units;
  for (size_t at = 0; at < stream.size();) {
    const size_t end = unit_end(stream, at);
    units.emplace_back(stream.begin() + static_cast<std::ptrdiff_t>(at),
                       stream.begin() + static_cast<std::ptrdiff_t>(end));
    at = end;
  }
  return units;
}

Stream join(const Units& units) {
  Stream stream;
  for (const Stream& unit : units) stream.insert(stream.end(), unit.begin(), unit.end());
  return stream;
}

Units without(const Units& units, size_t first, size_t last) {
  Units rest(units.begin(), units.begin() + static_cast<std::ptrdiff_t>(first));
  rest.insert(rest.end(), units.begin() + static_cast<std::ptrdiff_t>(last), units.end());
  return rest;
}

bool is_call(const Stream& unit, Command command) { return unit.size() == 1 && unit[0].command == command; }

// The unit that closes what `units[at]` opens, or the number of units.
size_t closing(const Units& units, size_t at) {
  const Command wanted = is_call(units[at], Command::glBegin) ? Command::glEnd : Command::glEndList;
  for (size_t i = at + 1; i < units.size(); ++i) {
    if (is_call(units[i], wanted)) return i;
  }
  return units.size();
}

// Some streams draw flat to leave out what is open, so that stays.
long flat_calls(const Stream& stream) {
  return std::count(stream.begin(), stream.end(), Call{Command::glShadeModel, {GL_FLAT}, {}});
}

class Shrinker {
 public:
  Shrinker(const Stream& stream, const std::function<bool(const Stream&)>& fails, int tries)
      : units_(split(stream)), flat_calls_(flat_calls(stream)), fails_(fails), tries_(tries) {}

  Stream run() {
    for (bool smaller = true; smaller && tries_ > 0;) {
      smaller = false;
      for (size_t run = std::max<size_t>(units_.size() / 2, 1); run > 0; run /= 2) smaller |= drop_runs(run);
      smaller |= drop_blocks();
    }
    return join(units_);
  }

 private:
  bool accept(Units candidate) {
    const Stream stream = join(candidate);
    if (tries_ <= 0 || !is_well_formed(stream) || flat_calls(stream) != flat_calls_) return false;
    --tries_;
    if (!fails_(stream)) return false;
    units_ = std::move(candidate);
    return true;
  }

  bool drop_runs(size_t run) {
    bool smaller = false;
    // From the end: what comes last depends on what is before, not the other way round.
    for (size_t end = units_.size(); end > 0;) {
      const size_t first = end > run ? end - run : 0;
      smaller |= accept(without(units_, first, end));
      end = std::min(first, units_.size());
    }
    return smaller;
  }

  // Whole Begin/End and NewList/EndList blocks, then their brackets alone.
  bool drop_blocks() {
    bool smaller = false;
    for (size_t at = units_.size(); at-- > 0;) {
      if (at >= units_.size()) continue;
      if (!is_call(units_[at], Command::glBegin) && !is_call(units_[at], Command::glNewList)) continue;
      const size_t end = closing(units_, at);
      if (end == units_.size()) continue;
      smaller |=
          accept(without(units_, at, end + 1)) || accept(without(without(units_, end, end + 1), at, at + 1));
    }
    return smaller;
  }

  Units units_;
  long flat_calls_;
  const std::function<bool(const Stream&)>& fails_;
  int tries_;
};

}  // namespace

Stream shrink(const Stream& stream, const std::function<bool(const Stream&)>& fails, int most_tries) {
  return Shrinker(stream, fails, most_tries).run();
}

}  // namespace halfspace::fuzz
