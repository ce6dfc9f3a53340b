#include "raster/thread_pool.h"

#include <pthread.h>
#include <signal.h>

#include <utility>

namespace halfspace::raster {
namespace {

// How often a thread looks before it sleeps or lets another run: some ten microseconds, the time to wake one.
constexpr int kLooks = 1000;

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

// For who waits for what another thread is about to finish.
void relax_or_yield(int looks) {
  if (looks < kLooks)
    relax();
  else
    std::this_thread::yield();
}

uint64_t packed(uint32_t begin, uint32_t end) { return uint64_t{end} << 32 | begin; }

}  // namespace

TaskLoop::TaskLoop(int workers)
    : workers_(static_cast<size_t>(workers)), stretches_(std::make_unique<Stretch[]>(workers_)) {}

void TaskLoop::open(std::span<const uint32_t> ends, const Task* task, uint64_t* times) {
  uint32_t begin = 0;
  for (size_t worker = 0; worker < workers_; ++worker) {
    stretches_[worker].range.store(packed(begin, ends[worker]), std::memory_order_relaxed);
    begin = ends[worker];
  }
  task_ = task;
  times_ = times;
  open_.store(true);
}

bool TaskLoop::take_first(Stretch& stretch, uint32_t& task) {
  uint64_t range = stretch.range.load(std::memory_order_relaxed);
  for (;;) {
    const auto begin = static_cast<uint32_t>(range), end = static_cast<uint32_t>(range >> 32);
    if (begin == end) return false;
    task = begin;
    if (stretch.range.compare_exchange_weak(range, packed(begin + 1, end), std::memory_order_relaxed))
      return true;
  }
}

bool TaskLoop::take_last(Stretch& stretch, uint32_t& task) {
  uint64_t range = stretch.range.load(std::memory_order_relaxed);
  for (;;) {
    const auto begin = static_cast<uint32_t>(range), end = static_cast<uint32_t>(range >> 32);
    if (begin == end) return false;
    task = end - 1;
    if (stretch.range.compare_exchange_weak(range, packed(begin, end - 1), std::memory_order_relaxed))
      return true;
  }
}

bool TaskLoop::take(int worker, uint32_t& task) {
  const auto own = static_cast<size_t>(worker);
  if (take_first(stretches_[own], task)) return true;
  for (size_t i = 1; i < workers_; ++i)
    if (take_last(stretches_[(own + i) % workers_], task)) return true;
  return false;
}

void TaskLoop::do_task(uint32_t task, int worker) {
  const uint64_t start = times_ != nullptr ? thread_nanoseconds() : 0;
  try {
    (*task_)(task, worker);
  } catch (...) {
    keep_exception();
  }
  if (times_ != nullptr) times_[task] = thread_nanoseconds() - start;
}

void TaskLoop::keep_exception() {
  const std::lock_guard lock(error_mutex_);
  if (!error_) error_ = std::current_exception();
}

// Whoever finds the loop open was counted before it looked, so that close() knows of it: of its own write and
// the other's, one of the two sees the other.
void TaskLoop::help(int worker, TaskLoop* first) {
  inside_.fetch_add(1);
  if (open_.load()) {
    for (uint32_t task; take(worker, task);) {
      if (first != nullptr && first->has_tasks()) first->help(worker);
      do_task(task, worker);
    }
  }
  inside_.fetch_sub(1);
}

bool TaskLoop::has_tasks() const {
  if (!open_.load(std::memory_order_relaxed)) return false;
  for (size_t worker = 0; worker < workers_; ++worker) {
    const uint64_t range = stretches_[worker].range.load(std::memory_order_relaxed);
    if (static_cast<uint32_t>(range) != static_cast<uint32_t>(range >> 32)) return true;
  }
  return false;
}

void TaskLoop::close() {
  open_.store(false);
  for (int looks = 0; inside_.load() != 0; ++looks) relax_or_yield(looks);
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

ThreadPool::ThreadPool(int threads)
    : size_(threads < 1 ? 1 : threads), front_(size_), back_(size_), trace_(TaskTrace::create(size_)) {}

ThreadPool::~ThreadPool() {
  try {
    wait();
  } catch (...) {  // nobody is left to hear of it
  }
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::start_threads() {
  // A program's signals are for its own threads.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  for (int worker = static_cast<int>(threads_.size()) + 1; worker < size_; ++worker)
    threads_.emplace_back([this, worker] { serve(worker); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void ThreadPool::serve(int worker) {
  uint32_t seen = 0;
  for (;;) {
    for (int looks = 0; looks < kLooks && loops_.load() == seen; ++looks) relax();
    if (loops_.load() == seen) {
      std::unique_lock lock(mutex_);
      ++sleepers_;
      wake_.wait(lock, [&] { return stop_.load() || loops_.load() != seen; });
      --sleepers_;
    }
    if (stop_.load()) return;
    seen = loops_.load();
    distance_.read();
    // What the caller waits for comes first, also when it begins in the middle of the other.
    do {
      front_.help(worker);
      prepare_back();
      back_.help(worker, &front_);
    } while (front_.has_tasks());
  }
}

void ThreadPool::wake() {
  if (threads_.empty()) start_threads();
  announce();
}

// That there is a loop to help with.
void ThreadPool::announce() {
  loops_.fetch_add(1);
  if (sleepers_.load() == 0) return;
  { const std::lock_guard lock(mutex_); }  // who counted itself a sleeper but does not sleep yet holds it
  wake_.notify_all();
}

void ThreadPool::run(uint32_t count, const Task& task) {
  if (size_ == 1 || count <= 1) {
    for (uint32_t i = 0; i < count; ++i) task(i, 0);
    return;
  }
  even_ends_.resize(static_cast<size_t>(size_));
  for (int worker = 0; worker < size_; ++worker) {
    const uint64_t parts = static_cast<uint64_t>(worker) + 1;
    even_ends_[static_cast<size_t>(worker)] =
        static_cast<uint32_t>(count * parts / static_cast<uint64_t>(size_));
  }
  front_.open(even_ends_, &task, trace_ ? trace_->begin_front(count) : nullptr);
  wake();
  front_.help(0);
  front_.close();
  if (trace_) trace_->end_front();
}

void ThreadPool::start(std::span<const uint32_t> ends, Task task) {
  wait();
  back_task_ = std::move(task);
  if (size_ == 1) {
    for (uint32_t i = 0; i < ends[0]; ++i) back_task_(i, 0);
    return;
  }
  back_.open(ends, &back_task_, trace_ ? trace_->begin_back(ends.back()) : nullptr);
  busy_ = true;
  wake();
}

void ThreadPool::start(Prepare prepare, Task task) {
  if (size_ == 1) return start(prepare(), std::move(task));
  wait();
  back_task_ = std::move(task);
  prepare_ = std::move(prepare);
  preparation_ = Preparation::open;
  busy_ = true;
  if (trace_) prepare_back();  // a trace is written by one thread
  wake();
}

// Where nobody has begun to.
void ThreadPool::prepare_back() {
  Preparation expected = Preparation::open;
  if (preparation_.load() != expected || !preparation_.compare_exchange_strong(expected, Preparation::begun))
    return;
  try {
    uint64_t* time = trace_ ? trace_->begin_prepare() : nullptr;
    const uint64_t start = time != nullptr ? thread_nanoseconds() : 0;
    const std::span<const uint32_t> ends = prepare_();
    if (time != nullptr) *time = thread_nanoseconds() - start;
    back_.open(ends, &back_task_, trace_ ? trace_->begin_back(ends.back()) : nullptr);
  } catch (...) {
    back_.keep_exception();
  }
  preparation_ = Preparation::done;
  if (size_ > 2) announce();  // who came meanwhile has found nothing to do
}

void ThreadPool::wait() {
  if (!busy_) return;
  prepare_back();
  for (int looks = 0; preparation_.load() != Preparation::done; ++looks) relax_or_yield(looks);
  busy_ = false;
  if (trace_) trace_->begin_wait();
  back_.help(0);
  back_.close();
  distance_.measure();
  if (trace_) trace_->end_wait();
}

void ThreadPool::note_picture() {
  if (trace_) trace_->picture();
}

}  // namespace halfspace::raster
