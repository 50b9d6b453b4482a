// Waiting OpenMP threads that sleep at once, instead of keeping a processor busy.
#pragma once

namespace reflines {

// Makes waiting threads of OpenMP sleep at once, in the whole process and to its end. Where other programs run, threads
// that spin while they wait keep those from running that they wait for: a press took three to ten times as long.
// On an idle machine presses take as long as before, steps of a drag up to a fifth longer.
// Environment variables that decide how threads wait (OMP_WAIT_POLICY, GOMP_SPINCOUNT) hold as the user set them.
// Does nothing where OpenMP is not libgomp on Linux: no other one that the project is built with spins.
void shorten_waits();

}  // namespace reflines
