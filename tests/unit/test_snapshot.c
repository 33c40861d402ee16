void test_snapshot(void);
void test_snapshot(void) {}
