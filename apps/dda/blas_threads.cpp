// OpenBLAS asks this function, its own unless the program has one, how many threads to start when it is
// loaded. The program uses one: others would wait busily at first, and where memory is short each would ask
// for its buffer of 128 MB for ever, so that the program never ended. Weak, for an OpenBLAS linked in.
extern "C" [[gnu::weak]] int openblas_num_threads_env() {
  return 1;
}
