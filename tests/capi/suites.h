// The suites that are written in C. Each returns how many checks failed.
#ifndef FILIGREE_TESTS_CAPI_SUITES_H
#define FILIGREE_TESTS_CAPI_SUITES_H

#ifdef __cplusplus
extern "C" {
#endif

int micromapsSuite(void);
int setsSuite(void);
int squaresSuite(void);
int gridsSuite(void);
int containersSuite(void);
int contextSuite(void);
int memorySuite(void);
int badInputSuite(void);

#ifdef __cplusplus
}
#endif

#endif
