displacement nearer(float by = 1;) { P -= vector(0, 0, by); }
