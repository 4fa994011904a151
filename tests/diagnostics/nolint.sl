// #pragma nolint silences the next statement, and only that.
surface s(string actual = "actualobject")
{
  point q = transform("object", P);
#pragma nolint
  q = transform(actual, "world",
                q);
  q = transform(actual, "world", q); // expect-warning: is in space "world" already
  Ci = xcomp(q);
}
