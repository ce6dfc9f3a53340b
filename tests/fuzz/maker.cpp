#include "maker.h"

#include <algorithm>

namespace halfspace::fuzz {
namespace {

const Feature& pick(Maker& maker, const std::vector<Feature>& features) {
  int total = 0;
  for (const Feature& feature : features) total += feature.weight;
  int at = maker.random.below(total);
  for (const Feature& feature : features) {
    if ((at -= feature.weight) < 0) return feature;
  }
  return features.back();
}

std::vector<Feature> select(const std::vector<std::string>& groups, bool draws, bool exact) {
  std::vector<Feature> selected;
  for (const Feature& feature : all_features()) {
    if (feature.draws != draws || (exact && !feature.exact)) continue;
    if (groups.empty() || std::find(groups.begin(), groups.end(), feature.group) != groups.end())
      selected.push_back(feature);
  }
  return selected;
}

// What is drawn lies about the unit cube; this brings it into the picture.
void set_up_view(Maker& maker) {
  Random& random = maker.random;
  maker.call(Command::glMatrixMode, {GL_PROJECTION});
  if (random.chance(50)) {
    maker.call(Command::glOrtho, {-1.25, 1.25, -1, 1, -2, 2});
  } else {
    maker.call(Command::glFrustum, {-0.625, 0.625, -0.5, 0.5, 1, 5});
    maker.call(Command::glTranslatef, {0, 0, -2.25});
  }
  maker.call(Command::glMatrixMode, {GL_MODELVIEW});
  if (random.chance(60))
    maker.call(Command::glRotatef, {random.real(-60, 60), random.real(-1, 1), random.real(-1, 1), 1});
  const std::vector<float> color = maker.color();
  maker.call(Command::glClearColor, {double(color[0]), double(color[1]), double(color[2]), double(color[3])});
  maker.call(Command::glClear, {GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT});
}

}  // namespace

std::vector<Feature> all_features() {
  std::vector<Feature> all;
  for (const auto* part : {&state_features(), &fragment_features(), &lighting_features(), &texture_features(),
                           &drawing_features(), &pixel_features(), &list_features(), &capture_features(),
                           &refused_features(), &client_features()})
    all.insert(all.end(), part->begin(), part->end());
  return all;
}

std::vector<std::string> all_groups() {
  std::vector<std::string> groups;
  for (const Feature& feature : all_features()) {
    if (std::find(groups.begin(), groups.end(), feature.group) == groups.end())
      groups.emplace_back(feature.group);
  }
  return groups;
}

std::vector<std::string> groups_without(const std::vector<std::string>& groups,
                                        const std::vector<std::string>& left_out) {
  std::vector<std::string> rest = groups.empty() ? all_groups() : groups;
  std::erase_if(rest, [&](const std::string& group) {
    return std::find(left_out.begin(), left_out.end(), group) != left_out.end();
  });
  return rest;
}

Stream make_stream(uint64_t seed, const std::vector<std::string>& groups) {
  Maker maker(seed);
  maker.exact = maker.random.chance(30);
  maker.decal = maker.random.chance(25);
  if (maker.exact) maker.call(Command::glShadeModel, {GL_FLAT});
  const std::vector<Feature> states = select(groups, false, maker.exact);
  std::vector<Feature> draws = select(groups, true, maker.exact);
  if (draws.empty()) draws = select({"shape"}, true, maker.exact);
  set_up_view(maker);
  // A few kinds of state a stream, so that they meet often: with all of them nothing would be seen any more.
  std::vector<Feature> chosen;
  const int kinds = states.empty() ? 0 : maker.random.between(1, 6);
  for (int i = 0; i < kinds; ++i) chosen.push_back(pick(maker, states));
  const int rounds = maker.random.between(2, 6);
  for (int round = 0; round < rounds; ++round) {
    const int changes = chosen.empty() ? 0 : maker.random.between(0, 4);
    for (int i = 0; i < changes; ++i) pick(maker, chosen).add(maker);
    const int shapes = maker.random.between(1, 3);
    for (int i = 0; i < shapes; ++i) pick(maker, draws).add(maker);
  }
  return maker.stream;
}

}  // namespace halfspace::fuzz
