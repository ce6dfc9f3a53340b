// OpenGL in an X11 window. Without --window the window is never mapped: the back buffer is drawn and read,
// not shown.
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>

#include <stdexcept>

#include "ref_app/backend.h"
#include "ref_app/gl_renderer.h"

namespace ref_app {
namespace {

class GlxBackend final : public Backend, public Window {
 public:
  explicit GlxBackend(const BackendOptions& options)
      : renderer_(options.width, options.height), visible_(options.visible) {
    try {
      create_window(options);
    } catch (...) {
      release();
      throw;
    }
  }
  ~GlxBackend() override { release(); }
  GlxBackend(const GlxBackend&) = delete;
  GlxBackend& operator=(const GlxBackend&) = delete;

  Renderer& renderer() override { return renderer_; }
  Window* window() override { return visible_ ? this : nullptr; }
  BackendStrings strings() override {
    return {gl_string(GL_RENDERER), gl_string(GL_VERSION), gl_string(GL_VENDOR)};
  }
  std::string take_errors() override { return take_gl_errors(); }

  void set_title(const std::string& title) override { XStoreName(display_, window_, title.c_str()); }
  KeyStroke next_key() override;
  void present() override { glXSwapBuffers(display_, window_); }

 private:
  void create_window(const BackendOptions& options);
  void release();

  GlRenderer renderer_;
  bool visible_;
  Display* display_ = nullptr;
  ::Window window_ = 0;
  GLXContext context_ = nullptr;
  Atom delete_window_ = 0;
};

void GlxBackend::create_window(const BackendOptions& options) {
  display_ = XOpenDisplay(nullptr);
  if (!display_) {
    throw std::runtime_error(
        "cannot open the X display; set DISPLAY, run under xvfb-run, or use --backend osmesa");
  }
  int attributes[] = {GLX_RGBA, GLX_DEPTH_SIZE, 24, GLX_DOUBLEBUFFER, None};
  XVisualInfo* visual = glXChooseVisual(display_, DefaultScreen(display_), attributes);
  if (!visual)
    throw std::runtime_error("this X display has no double-buffered RGBA visual with a 24-bit depth buffer");

  const ::Window root = RootWindow(display_, visual->screen);
  XSetWindowAttributes window_attributes{};
  window_attributes.colormap = XCreateColormap(display_, root, visual->visual, AllocNone);
  window_attributes.event_mask = KeyPressMask | StructureNotifyMask;
  window_ = XCreateWindow(display_, root, 0, 0, static_cast<unsigned>(options.width),
                          static_cast<unsigned>(options.height), 0, visual->depth, InputOutput,
                          visual->visual, CWColormap | CWEventMask | CWBorderPixel, &window_attributes);
  delete_window_ = XInternAtom(display_, "WM_DELETE_WINDOW", False);
  XSetWMProtocols(display_, window_, &delete_window_, 1);
  if (visible_) XMapWindow(display_, window_);

  context_ = glXCreateContext(display_, visual, nullptr, True);
  XFree(visual);
  if (!context_) throw std::runtime_error("glXCreateContext gave no context");
  if (!glXMakeCurrent(display_, window_, context_)) throw std::runtime_error("glXMakeCurrent failed");
}

void GlxBackend::release() {
  if (!display_) return;
  if (context_) {
    glXMakeCurrent(display_, None, nullptr);
    glXDestroyContext(display_, context_);
  }
  if (window_) XDestroyWindow(display_, window_);
  XCloseDisplay(display_);
}

KeyStroke key_of(KeySym symbol) {
  if (symbol >= XK_1 && symbol <= XK_9) return {Key::digit, static_cast<int>(symbol - XK_1) + 1};
  switch (symbol) {
    case XK_Left:
      return {Key::left};
    case XK_Right:
      return {Key::right};
    case XK_Up:
      return {Key::up};
    case XK_Down:
      return {Key::down};
    case XK_space:
      return {Key::space};
    case XK_n:
    case XK_Next:
      return {Key::next};
    case XK_p:
    case XK_Prior:
      return {Key::previous};
    case XK_q:
    case XK_Escape:
      return {Key::quit};
    default:
      return {};
  }
}

KeyStroke GlxBackend::next_key() {
  while (XPending(display_) > 0) {
    XEvent event;
    XNextEvent(display_, &event);
    if (event.type == ConfigureNotify) {
      renderer_.resize(event.xconfigure.width, event.xconfigure.height);
    } else if (event.type == ClientMessage && static_cast<Atom>(event.xclient.data.l[0]) == delete_window_) {
      return {Key::quit};
    } else if (event.type == KeyPress) {
      const KeyStroke pressed = key_of(XLookupKeysym(&event.xkey, 0));
      if (pressed.key != Key::none) return pressed;
    }
  }
  return {};
}

}  // namespace

std::unique_ptr<Backend> make_backend(const BackendOptions& options) {
  return std::make_unique<GlxBackend>(options);
}
const char* backend_name() { return "glx"; }

}  // namespace ref_app
