# breakwater_use_deal_ii(TARGET): for targets whose files include deal.II headers.
# Such a target links its libraries without PRIVATE or PUBLIC, as deal_ii_setup_target() does.
macro(breakwater_use_deal_ii target)
  deal_ii_setup_target(${target})
endmacro()
