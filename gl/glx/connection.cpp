#include "gl/glx/connection.h"

#include <X11/extensions/XShm.h>
#include <sys/socket.h>

#include <algorithm>
#include <climits>
#include <vector>
// Last: it defines macros with short names. Async handlers, which alone see an error before the program's
// handler does, and the close hook are declared nowhere else.
#include <X11/Xlibint.h>

namespace halfspace::gl::glx {

struct Connection::ErrorFilter {
  struct Range {
    unsigned long first, last;  // request serials
    bool failed;
  };
  _XAsyncHandler handler{};
  std::vector<Range> ranges;  // touched only while the display is locked
};

namespace {

Bool swallow_our_errors(Display* display, xReply* reply, char*, int, XPointer data) {
  if (reply->generic.type != X_Error) return False;
  const unsigned long serial = LastKnownRequestProcessed(display);
  for (auto& range : reinterpret_cast<Connection::ErrorFilter*>(data)->ranges) {
    if (serial < range.first || serial > range.last) continue;
    range.failed = true;
    return True;
  }
  return False;
}

bool is_local(Display* display) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  return getsockname(ConnectionNumber(display), reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
         address.ss_family == AF_UNIX;
}

void (*closing)(Display*) = nullptr;

int close_hook(Display* display, XExtCodes*) {
  closing(display);
  return 0;
}

}  // namespace

Connection::Connection(Display* display, void (*on_close)(Display*))
    : display_(display), filter_(std::make_unique<ErrorFilter>()) {
  // Before our close hook is set: the hooks run last first, and ours still detaches shared memory.
  has_shared_memory_ = is_local(display) && ImageByteOrder(display) == LSBFirst && XShmQueryExtension(display);
  closing = on_close;
  if (XExtCodes* codes = XAddExtension(display)) XESetCloseDisplay(display, codes->extension, close_hook);
  has_shared_memory_ =
      is_local(display) && ImageByteOrder(display) == LSBFirst && XShmQueryExtension(display);
  XLockDisplay(display);
  filter_->handler.next = display->async_handlers;
  filter_->handler.handler = swallow_our_errors;
  filter_->handler.data = reinterpret_cast<XPointer>(filter_.get());
  display->async_handlers = &filter_->handler;
  XUnlockDisplay(display);
}

Connection::~Connection() = default;

void Connection::close() {
  if (!display_) return;
  XSync(display_, False);
  XLockDisplay(display_);
  DeqAsyncHandler(display_, &filter_->handler);
  XUnlockDisplay(display_);
  display_ = nullptr;
}

XID Connection::allocate_id() {
  Display* dpy = display_;  // SyncHandle's own name for it
  LockDisplay(dpy);
  const XID id = XAllocID(dpy);
  UnlockDisplay(dpy);
  SyncHandle();  // refills the id, where Xlib runs without locks
  return id;
}

RequestScope::RequestScope(Connection& connection) : connection_(connection) {
  Display* display = connection_.display_;
  XLockDisplay(display);
  first_ = NextRequest(display);
  auto& ranges = connection_.filter_->ranges;
  const unsigned long answered = LastKnownRequestProcessed(display);
  std::erase_if(ranges, [answered](const auto& range) { return range.last < answered; });
  ranges.push_back({first_, ULONG_MAX, false});
}

RequestScope::~RequestScope() {
  Display* display = connection_.display_;
  for (auto& range : connection_.filter_->ranges) {
    if (range.first == first_ && range.last == ULONG_MAX) range.last = NextRequest(display) - 1;
  }
  XUnlockDisplay(display);
}

bool RequestScope::sync() {
  XSync(connection_.display_, False);
  const auto& ranges = connection_.filter_->ranges;
  return std::none_of(ranges.begin(), ranges.end(),
                      [this](const auto& range) { return range.first == first_ && range.failed; });
}

}  // namespace halfspace::gl::glx
