// The heap of a program that lives as long as one picture takes.
#pragma once

namespace render::tools {

/// Makes room for what small pictures need, in huge pages where the system has them: page by page the memory
/// takes a twentieth of their time. What is free again is kept for the next. Before anything else.
void make_roomy_heap();

} // namespace render::tools
