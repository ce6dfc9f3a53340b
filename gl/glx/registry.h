// What this process knows of GLX: its displays, and everything handed out as a handle.
#pragma once

#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "gl/glx/connection.h"
#include "gl/glx/drawable.h"
#include "gl/glx/fb_config.h"
#include "state/context.h"

namespace halfspace::gl::glx {

struct GlxContext {
  FbConfig config;
  Display* display = nullptr;
  XID id = 0;
  XID share_id = 0;
  std::unique_ptr<state::Context> gl;
  bool current = false;                     // to some thread
  bool destroyed = false;                   // dies when it is released
  std::shared_ptr<GlxDrawable> draw, read;  // while current
  XID draw_id = 0, read_id = 0;             // as the program named them

  GLXContext handle() { return reinterpret_cast<GLXContext>(this); }
};

// What belongs to one open Display, and goes when it is closed.
struct DisplayData {
  std::shared_ptr<Connection> connection;
  std::vector<std::vector<FbConfig>> screens;
  std::unordered_map<XID, std::shared_ptr<GlxDrawable>> drawables;
  // An X visual stands for several configs. The XVisualInfo we handed out says which one was meant; for a
  // copy of it, the last config chosen for that visual is taken.
  std::unordered_map<const XVisualInfo*, const FbConfig*> handed_out;
  std::unordered_map<VisualID, const FbConfig*> last_chosen;

  const std::vector<FbConfig>* screen(int number) const;
  // `handle` as a config of this display, or null.
  const FbConfig* find_config(GLXFBConfig handle) const;
  // The config a visual stands for, or null when it has none.
  const FbConfig* config_of(const XVisualInfo& visual) const;
  // The X visual of a config, to be freed with XFree; null when out of memory.
  XVisualInfo* visual_info(const FbConfig& config);
  // A drawable by GLX id, or the GLXWindow made for an X window.
  std::shared_ptr<GlxDrawable> find_drawable(XID id) const;
  // Lets go of X windows nobody draws to and the server no longer has.
  void sweep();
};

class Registry {
 public:
  // One for the process, never destroyed: threads and exit handlers may call us to the very end.
  static Registry& get();

  std::mutex mutex;  // guards all of it

  // The data of an open display, made at its first use.
  DisplayData& display(Display* display);
  // Takes ownership; returns the handle.
  GLXContext add(std::unique_ptr<GlxContext> context);
  // Null for what is no live context of ours.
  GlxContext* find(GLXContext handle) const;
  void destroy(GlxContext* context);

 private:
  static void close(Display* display);

  std::unordered_map<Display*, std::unique_ptr<DisplayData>> displays_;
  std::unordered_map<GlxContext*, std::unique_ptr<GlxContext>> contexts_;
};

}  // namespace halfspace::gl::glx
