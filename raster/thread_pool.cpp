#include "raster/thread_pool.h"

#include <pthread.h>
#include <signal.h>

#include <utility>

namespace halfspace::raster {

ThreadPool::ThreadPool(int threads) : size_(threads < 1 ? 1 : threads) {}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::start() {
  // A program's signals are for its own threads.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  for (int worker = static_cast<int>(threads_.size()) + 1; worker < size_; ++worker)
    threads_.emplace_back([this, worker] { serve(worker); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void ThreadPool::work(int worker) {
  try {
    for (uint32_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) (*task_)(i, worker);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
  }
}

void ThreadPool::serve(int worker) {
  uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
    }
    work(worker);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void ThreadPool::run(uint32_t count, const std::function<void(uint32_t, int)>& task) {
  if (size_ == 1 || count <= 1) {
    for (uint32_t i = 0; i < count; ++i) task(i, 0);
    return;
  }
  if (threads_.empty()) start();
  {
    const std::lock_guard lock(mutex_);
    task_ = &task;
    count_ = count;
    next_.store(0, std::memory_order_relaxed);
    busy_ = static_cast<int>(threads_.size());
    ++round_;
  }
  wake_.notify_all();
  work(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return busy_ == 0; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

}  // namespace halfspace::raster
