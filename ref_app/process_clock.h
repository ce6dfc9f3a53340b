// When did this process start, and how much memory has it held?
#pragma once

#include <string>

namespace ref_app {

// Call first thing in main. Takes the start from REF_APP_START_NS (CLOCK_MONOTONIC, set by who started us) or
// else estimates it: now, less the processor time the process has used so far, which is what loading it took.
void note_process_start();
// Hands the start on to a program this process is about to become.
void export_process_start();
double milliseconds_since_process_start();
// "environment" or "estimate".
std::string process_start_source();

// Processor time of this process so far, over all its threads.
double processor_milliseconds();

// Peak resident set since the program was loaded, in KiB; 0 where there is no /proc.
long peak_memory_kib();

}  // namespace ref_app
