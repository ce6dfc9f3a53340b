// One X connection as GLX needs it: errors of our own requests stay with us, ids are allocated, and its end
// is seen.
#pragma once

#include <X11/Xlib.h>

#include <memory>

namespace halfspace::gl::glx {

class Connection {
 public:
  // `on_close` is called, once, while `display` is being closed and can still be used.
  Connection(Display* display, void (*on_close)(Display*));
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Null once the connection is closed: whoever still draws, draws to memory only.
  Display* display() const { return display_; }
  // Whether the server is on this machine and has MIT-SHM.
  bool has_shared_memory() const { return has_shared_memory_; }
  void shared_memory_failed() { has_shared_memory_ = false; }

  // An id nobody else uses on this connection.
  XID allocate_id();

  // The end, for on_close: waits until the server has answered all our requests, and forgets the display.
  void close();

  struct ErrorFilter;

 private:
  friend class RequestScope;
  Display* display_;
  std::unique_ptr<ErrorFilter> filter_;
  bool has_shared_memory_ = false;
};

// Requests made on the connection while one of these stands are ours: an X error that they cause, now or when
// the server comes to it, is swallowed, and never reaches the program's error handler (a window may die under
// us at any time). The display is locked meanwhile.
class RequestScope {
 public:
  explicit RequestScope(Connection& connection);
  ~RequestScope();
  RequestScope(const RequestScope&) = delete;
  RequestScope& operator=(const RequestScope&) = delete;

  // Waits for the server; whether all requests so far went well.
  bool sync();

 private:
  Connection& connection_;
  unsigned long first_;
};

}  // namespace halfspace::gl::glx
