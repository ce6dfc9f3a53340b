// Loops of independent tasks spread over threads: one that the caller waits for, and one that goes on behind
// it.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "raster/cache_distance.h"
#include "raster/task_trace.h"

namespace halfspace::raster {

// Tasks [0, count) dealt to the workers in stretches. A worker takes its own from the front, so that the same
// worker meets the same data again, and when it has none left, one at a time from the back of another's.
class TaskLoop {
 public:
  using Task = std::function<void(uint32_t task, int worker)>;
  explicit TaskLoop(int workers);

  // ends: where each worker's stretch ends; the first begins at 0. Nobody may be inside. times: of each task,
  // when that is to be noted.
  void open(std::span<const uint32_t> ends, const Task* task, uint64_t* times = nullptr);
  // Takes tasks until none is left; those of `first`, if it has any, before each. What a task throws is kept
  // for close(). Any thread, any time.
  void help(int worker, TaskLoop* first = nullptr);
  bool has_tasks() const;
  // Once no task is left to take: returns when all are done, and throws the first exception of one.
  void close();
  // Keeps the exception that is being handled for close().
  void keep_exception();

 private:
  struct alignas(64) Stretch {
    std::atomic<uint64_t> range{0};  // begin in the low half, end in the high one
  };
  static bool take_first(Stretch& stretch, uint32_t& task);
  static bool take_last(Stretch& stretch, uint32_t& task);
  bool take(int worker, uint32_t& task);
  void do_task(uint32_t task, int worker);

  const size_t workers_;
  std::unique_ptr<Stretch[]> stretches_;
  const Task* task_ = nullptr;
  uint64_t* times_ = nullptr;
  std::atomic<bool> open_{false};
  std::atomic<int> inside_{0};  // threads that are looking for tasks or doing one
  std::mutex error_mutex_;
  std::exception_ptr error_;
};

// All calls come from one thread, worker 0.
class ThreadPool {
 public:
  using Task = TaskLoop::Task;
  // threads >= 1, the caller's own included; the others start at the first loop that can use them.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return size_; }
  // Calls task(i, worker) for every i in [0, count), each once, worker in [0, size()). Returns when all are
  // done. The first exception of a task is thrown here, after the others have finished.
  void run(uint32_t count, const Task& task);
  // The same, and returns at once: the tasks are done meanwhile, or by wait() at the latest. ends: as
  // TaskLoop::open takes them. One such loop at a time; run() may be called before it is waited for.
  void start(std::span<const uint32_t> ends, Task task);
  // The same where something has to be done before it is known what the tasks are: by whichever thread comes
  // first, once. What prepare() returns has to stay until the tasks are done; what it throws is thrown by
  // wait(), without tasks.
  using Prepare = std::function<std::span<const uint32_t>()>;
  void start(Prepare prepare, Task task);
  // Helps with what start() began, and returns when it is done. Throws the first exception of a task.
  void wait();
  // Whether what the other threads have read is slow to write for the caller.
  bool is_far() const { return distance_.is_far(); }
  // Notes in the trace, if there is one, that a picture is finished.
  void note_picture();
  // Whether tasks of that loop still wait for somebody.
  bool is_busy() const { return busy_ && (preparation_.load() != Preparation::done || back_.has_tasks()); }

 private:
  enum class Preparation { open, begun, done };
  void start_threads();
  void serve(int worker);
  void wake();
  void announce();
  void prepare_back();

  const int size_;
  std::vector<std::thread> threads_;
  TaskLoop front_, back_;  // of run() and of start()
  std::unique_ptr<TaskTrace> trace_;
  CacheDistance distance_;  // from the caller to the others
  Task back_task_;
  Prepare prepare_;
  std::atomic<Preparation> preparation_{Preparation::done};
  bool busy_ = false;
  std::vector<uint32_t> even_ends_;
  // Who finds no task watches the count of loops for a moment, then sleeps.
  std::atomic<uint32_t> loops_{0};
  std::atomic<int> sleepers_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
};

}  // namespace halfspace::raster
