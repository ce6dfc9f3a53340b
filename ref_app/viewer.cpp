#include "ref_app/viewer.h"

#include <chrono>
#include <cstdio>
#include <thread>

#include "ref_app/input_error.h"
#include "ref_app/scenes.h"

namespace ref_app {
namespace {

constexpr float kTurn = 0.08F;  // radians a key press
constexpr auto kIdle = std::chrono::milliseconds(15);

using Clock = std::chrono::steady_clock;

class Viewer {
 public:
  Viewer(Backend& backend, Window& window, const Options& options)
      : backend_(backend),
        window_(window),
        assets_(options.assets, options.model),
        number_(options.scenes.front()),
        moving_(options.animate) {}

  int run() {
    open_scene();
    Clock::time_point last = Clock::now();
    while (handle_keys()) {
      const Clock::time_point now = Clock::now();
      if (moving_) motion_.seconds += std::chrono::duration<float>(now - last).count();
      last = now;
      scene_->draw(backend_.renderer(), motion_);
      window_.present();
      count_frame();
      if (!moving_) std::this_thread::sleep_for(kIdle);
    }
    return 0;
  }

 private:
  void open_scene() {
    scene_.reset();  // its images go before the next one's come
    scene_ = make_scene(number_, backend_.renderer(), assets_);
    motion_ = {};
    frames_ = 0;
    counted_since_ = Clock::now();
  }

  void choose(int number) {
    number_ = (number - 1 + kSceneCount) % kSceneCount + 1;
    open_scene();
  }

  // False when the user wants to leave.
  bool handle_keys() {
    for (KeyStroke stroke = window_.next_key(); stroke.key != Key::none; stroke = window_.next_key()) {
      switch (stroke.key) {
        case Key::left:
          motion_.yaw -= kTurn;
          break;
        case Key::right:
          motion_.yaw += kTurn;
          break;
        case Key::up:
          motion_.pitch += kTurn;
          break;
        case Key::down:
          motion_.pitch -= kTurn;
          break;
        case Key::space:
          moving_ = !moving_;
          break;
        case Key::next:
          choose(number_ + 1);
          break;
        case Key::previous:
          choose(number_ - 1);
          break;
        case Key::digit:
          if (stroke.digit <= kSceneCount) choose(stroke.digit);
          break;
        case Key::quit:
          return false;
        case Key::none:
          break;
      }
    }
    return true;
  }

  void count_frame() {
    ++frames_;
    const double seconds = std::chrono::duration<double>(Clock::now() - counted_since_).count();
    if (seconds < 1.0) return;
    char title[160];
    std::snprintf(title, sizeof title, "%d  %s  -  %.0f frames a second  -  %s", number_, scene_name(number_),
                  frames_ / seconds, backend_.strings().renderer.c_str());
    window_.set_title(title);
    frames_ = 0;
    counted_since_ = Clock::now();
  }

  Backend& backend_;
  Window& window_;
  Assets assets_;
  std::unique_ptr<Scene> scene_;
  Motion motion_;
  int number_;
  bool moving_;
  int frames_ = 0;
  Clock::time_point counted_since_;
};

}  // namespace

int run_viewer(Backend& backend, const Options& options) {
  Window* window = backend.window();
  if (!window)
    throw InputError(std::string("the backend ") + backend_name() + " has no window to show; use glx");
  return Viewer(backend, *window, options).run();
}

}  // namespace ref_app
