void test_link_safety(void);
void test_link_safety(void) {}
