// Fork and join: a loop of independent tasks spread over threads that wait between loops.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace halfspace::raster {

class ThreadPool {
 public:
  // threads >= 1, the caller's own included; the others start at the first loop that can use them.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const { return size_; }
  // Calls task(i, worker) for every i in [0, count), each once, worker in [0, size()). Returns when all are done.
  // The first exception of a task is thrown here, after the others have finished.
  void run(uint32_t count, const std::function<void(uint32_t, int)>& task);

 private:
  void start();
  void serve(int worker);
  void work(int worker);

  const int size_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  uint64_t round_ = 0;
  int busy_ = 0;
  bool stop_ = false;
  const std::function<void(uint32_t, int)>* task_ = nullptr;
  std::exception_ptr error_;
  uint32_t count_ = 0;
  std::atomic<uint32_t> next_{0};
};

}  // namespace halfspace::raster
